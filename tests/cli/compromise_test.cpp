// Where a method follows a scene in part only, the run says so wherever a user may look, once, with what is enough.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const std::string warning = "sheet/stiffness: explicit steps follow ";

std::vector<std::string> with_explicit_steps(std::vector<std::string> arguments) {
    for (const char* setting : {"/solver/method=\"explicit\"", "/solver/substeps=1"}) {
        arguments.push_back("--set");
        arguments.push_back(setting);
    }
    return arguments;
}

TEST(Compromises, AreWarnedAboutOnceAndListedApartFromWhatIsSkipped) {
    const SceneFolder folder(small_scene(2));
    const Outcome outcome = drape(with_explicit_steps({"simulate", folder.scene(), "-o", folder.out(), "-q"}));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::size_t said = outcome.err.find("warning: " + warning);
    ASSERT_NE(said, std::string::npos) << outcome.err;
    EXPECT_THAT(outcome.err, AllOf(HasSubstr(" at 1 substeps; "), HasSubstr(" substeps would follow all of it")));
    EXPECT_EQ(outcome.err.find(warning, said + 10), std::string::npos) << outcome.err;
    const std::string manifest = read_text(folder / "out/manifest.json");
    EXPECT_THAT(manifest, AllOf(HasSubstr("\"compromises\": ["), HasSubstr("\"enough_substeps\": "),
                                HasSubstr("\"what\": \"sheet/stiffness\"")));
}

TEST(Compromises, AreKnownToCheckWhereTheMethodIsNamed) {
    const SceneFolder folder(small_scene(2));
    EXPECT_THAT(drape(with_explicit_steps({"check", folder.scene()})).err, HasSubstr(warning));
    EXPECT_THAT(drape(with_explicit_steps({"check", "--json", folder.scene()})).out,
                AllOf(HasSubstr("\"compromises\""), HasSubstr("explicit steps follow ")));
    EXPECT_THAT(drape({"check", folder.scene()}).err, Not(HasSubstr("follow")));
    EXPECT_THAT(drape(with_explicit_steps({"graph", folder.scene(), "--simulate"})).out,
                HasSubstr("\ncompromised:\n  " + warning));
}

}  // namespace
}  // namespace drape
