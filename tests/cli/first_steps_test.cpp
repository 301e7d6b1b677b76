// A newcomer meets templates, help on commands, "did you mean", completions and the manual page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Runs a program of this machine, found in PATH.
Outcome shell(const std::string& command, const StartOptions& options = {}) {
    return Running("/bin/sh", {"-c", command}, options).wait();
}

bool is_installed(const std::string& program) { return shell("command -v " + program + " >/dev/null").code == 0; }

class Templates : public testing::TestWithParam<const char*> {};

TEST_P(Templates, IsAGoodSceneAndRuns) {
    const TemporaryFolder folder;
    const std::string name = GetParam(), file = name + ".json";
    const Outcome made = drape({"new", name}, {.folder = folder.path()});
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(made.err, HasSubstr("Next: drape render " + file + " -o out/" + name));
    const Outcome check = drape({"check", file}, {.folder = folder.path()});
    EXPECT_EQ(check.code, 0);
    EXPECT_THAT(check.err, IsEmpty());
    const std::string scene = read_text(folder / file);
    EXPECT_THAT(scene, AllOf(HasSubstr("// "), HasSubstr("\"fabric\"")));
    const Outcome run = drape(
        {"render", file, "-o", "out", "-q", "-j", "75", "-e", "75", "--size", "64x36", "--samples", "1", "--validate"},
        {.folder = folder.path()});
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_THAT(run.err, IsEmpty());
    EXPECT_THAT(frame_numbers(folder / "out"), ElementsAre(0, 75));
    EXPECT_NE(read_text(folder / "out/frame_0000.png"), read_text(folder / "out/frame_0075.png"));

    write_text(folder / file, "mine");
    const Outcome again = drape({"new", name}, {.folder = folder.path()});
    EXPECT_EQ(again.code, 1);
    EXPECT_THAT(again.err, HasSubstr("'" + file + "' exists already: nothing was written"));
    EXPECT_EQ(read_text(folder / file), "mine");
    EXPECT_EQ(drape({"new", name, "-o", "-"}, {.folder = folder.path()}).out, scene);
}
INSTANTIATE_TEST_SUITE_P(New, Templates, testing::Values("table", "flag", "curtain", "ball", "cut"),
                         [](const auto& test) { return std::string(test.param); });

TEST(New, NamesTheTemplateThatIsMeant) {
    const TemporaryFolder folder;
    const Outcome outcome = drape({"new", "tabel"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("there is no template 'tabel': did you mean 'table'?"));
    EXPECT_THAT(drape({"new", "teapot"}).err, HasSubstr("expected one of table, flag, curtain, ball, cut"));
    EXPECT_EQ(drape({"new", "table", "-o", "absent/table.json"}, {.folder = folder.path()}).code, 1);
    EXPECT_THAT(names_in(folder.path()), IsEmpty());
}

TEST(DidYouMean, ACommandOrAnOption) {
    EXPECT_THAT(drape({"rendr", "a.json"}).err, HasSubstr("unknown command 'rendr': did you mean 'render'?"));
    EXPECT_THAT(drape({"bench", "sped"}).err, HasSubstr("drape: unknown command 'sped': did you mean 'speed'?"));
    EXPECT_THAT(drape({"bench"}).err, HasSubstr("no command given: expected one of accuracy, "));
    EXPECT_THAT(drape({"render", "a.json", "-o", "b", "--frames", "3", "--valdate", "--sampels=1"}).err,
                AllOf(HasSubstr("not expected: --valdate: did you mean '--validate'?"),
                      HasSubstr("not expected: --sampels=1: did you mean '--samples'?")));
}

TEST(Help, OfACommandByItsName) {
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{}, {"render"}, {"bench", "speed"}, {"help"}, {"man"}}) {
        std::vector<std::string> by_name = command, by_option = command;
        by_name.insert(by_name.begin(), "help");
        by_option.push_back("--help");
        const Outcome outcome = drape(by_name);
        EXPECT_EQ(outcome.code, 0);
        EXPECT_EQ(outcome.out, drape(by_option).out);
    }
    const Outcome unknown = drape({"help", "simulat"});
    EXPECT_EQ(unknown.code, 2);
    EXPECT_THAT(unknown.err, HasSubstr("no help on 'simulat': did you mean 'simulate'?"));
    EXPECT_EQ(drape({"-V"}).out, drape({"--version"}).out);
}

/// Returns what bash offers after these words.
std::string bash_offers(const std::string& words) {
    const std::string script = "source <('" DRAPE_PROGRAM "' completions bash); COMP_WORDS=('" DRAPE_PROGRAM "' " +
                               words +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]}-1)); _drape; printf '%s ' \"${COMPREPLY[@]}\"";
    const Outcome outcome = Running("/bin/bash", {"-uc", script}).wait();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, IsEmpty());
    return outcome.out;
}

TEST(Completions, BashOffersCommandsOptionsAndChoices) {
    EXPECT_THAT(bash_offers("re"), HasSubstr("render "));
    EXPECT_EQ(bash_offers("bench sp"), "speed ");
    EXPECT_EQ(bash_offers("render --samp"), "--samples ");
    EXPECT_EQ(bash_offers("render --samples ''"), "1 4 ");
    EXPECT_EQ(bash_offers("bench speed --sho"), "--short ");
    EXPECT_EQ(bash_offers("new t"), "table ");
    EXPECT_EQ(bash_offers("completions f"), "fish ");
}

TEST(Completions, AreWordsWithTheirHelpOrFilesOrFolders) {
    const auto offered = [](std::vector<std::string> words) {
        words.insert(words.begin(), {"completions", "words", "--"});
        return drape(words).out;
    };
    EXPECT_THAT(offered({"re"}), HasSubstr("render\tSimulate a scene and draw it\n"));
    EXPECT_THAT(offered({"bench", ""}), AllOf(HasSubstr("speed\t"), Not(HasSubstr("render"))));
    EXPECT_EQ(offered({"render", "a.json", "-o", ""}), ":folders\n");
    EXPECT_EQ(offered({"bench", "speed", "--json", "a"}), ":files\n");
    EXPECT_EQ(offered({"render", ""}), ":files\n");
    EXPECT_THAT(offered({"render", "-"}), HasSubstr("--samples\tSamples per pixel\n"));
    EXPECT_THAT(offered({"new", ""}), HasSubstr("flag\ta flag on its pole in gusty wind\n"));
    EXPECT_EQ(offered({"report", "--frames", ""}), "");
}

TEST(Completions, OtherShellsReadTheirs) {
    for (const char* name : {"zsh", "fish"}) {
        const Outcome script = drape({"completions", name});
        EXPECT_EQ(script.code, 0);
        EXPECT_THAT(script.out, HasSubstr("completions words --"));
        const TemporaryFolder folder;
        write_text(folder / "script", script.out);
        if (!is_installed(name)) continue;  // CI has bash alone
        const Outcome read = shell(std::string(name) + " -n script", {.folder = folder.path()});
        EXPECT_EQ(read.code, 0) << read.err;
    }
    EXPECT_EQ(drape({"completions", "csh"}).code, 2);
}

TEST(ManualPage, HasEveryCommandAndOption) {
    const std::string page = drape({"man"}).out;
    for (const char* words :
         {".TH DRAPE 1", ".SS \"drape render\"", ".SS \"drape bench speed\"", "\\-\\-overwrite", ".SH \"EXIT STATUS\""})
        EXPECT_THAT(page, HasSubstr(words));
    if (!is_installed("groff")) return;  // CI has none
    const TemporaryFolder folder;
    write_text(folder / "drape.1", page);
    const Outcome shown = shell("groff -man -Tutf8 -ww drape.1", {.folder = folder.path()});
    EXPECT_EQ(shown.code, 0);
    EXPECT_THAT(shown.err, IsEmpty());
}

}  // namespace
}  // namespace drape
