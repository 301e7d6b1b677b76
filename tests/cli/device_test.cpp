// Devices, drivers and the validation layer are found, missing or unknown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <json/json.h>

#include <algorithm>
#include <sstream>

#include "program.h"
#include "scenes.h"

namespace drape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Json::Value devices() {
    const Outcome outcome = drape({"devices", "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::istringstream stream(outcome.out);
    Json::Value list;
    std::string errors;
    EXPECT_TRUE(Json::parseFromStream(Json::CharReaderBuilder(), stream, &list, &errors)) << errors;
    return list;
}

// Older loaders read the first name, newer ones the second.
const std::vector<std::string> no_driver = {"VK_ICD_FILENAMES=/nowhere/driver.json",
                                            "VK_DRIVER_FILES=/nowhere/driver.json"};

TEST(Devices, AreListedAsTextAndJson) {
    const Json::Value list = devices();
    ASSERT_GE(list.size(), 1u);
    const Outcome text = drape({"devices"});
    EXPECT_EQ(text.code, 0);
    EXPECT_THAT(text.out, AllOf(HasSubstr("0: " + list[0]["name"].asString()), HasSubstr(list[0]["uuid"].asString())));
}

TEST(Devices, AreChosenByIndexUuidAndTheEnvironment) {
    const SceneFolder folder(small_scene(1));
    const auto uuid = [&](const std::vector<std::string>& options, const std::vector<std::string>& environment = {}) {
        std::vector<std::string> arguments{"simulate", folder.scene(), "-o", folder.out(), "--overwrite"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const Outcome outcome = drape(arguments, {.environment = environment});
        EXPECT_EQ(outcome.code, 0) << testing::PrintToString(options) << ": " << outcome.err;
        return lasting_manifest(folder.out())["device"]["uuid"].asString();
    };
    const std::string chosen = uuid({});  // by this program's environment
    const Json::Value list = devices();
    const auto same =
        std::find_if(list.begin(), list.end(), [&](const Json::Value& one) { return one["uuid"] == chosen; });
    ASSERT_NE(same, list.end());
    const std::string index = (*same)["index"].asString();
    EXPECT_EQ(uuid({"--device", index}), chosen);
    EXPECT_EQ(uuid({"--device", chosen}), chosen);
    EXPECT_EQ(uuid({}, {"DRAPE_DEVICE=" + index}), chosen);
    EXPECT_EQ(uuid({"--device", index}, {"DRAPE_DEVICE=no such device"}), chosen);
}

/// Of a whole run: descriptor sets, storage buffers for texels, the smallest groups.
TEST(Devices, WithoutWhatADeviceMayLackARunHasTheSameBytes) {
    const SceneFolder folder(small_scene(3));
    const auto bytes = [&](const std::string& without) {
        const Outcome outcome = drape({"render", folder.scene(), "-o", folder.out(), "--overwrite", "--validate",
                                       "--export", "npy", "--size", "96x54"},
                                      {.environment = {"DRAPE_WITHOUT=" + without}});
        EXPECT_EQ(outcome.code, 0) << without << ": " << outcome.err;
        std::map<std::string, std::string> files = everything_below(folder.out());
        files.erase("manifest.json");
        return files;
    };
    const auto usual = bytes("");
    EXPECT_GE(usual.size(), 4u);
    EXPECT_EQ(bytes("push_descriptors,texel_buffers,wide_integers,wide_atomics,shuffles,full_subgroups,shared_memory,"
                    "timestamps"),
              usual);
    const Outcome wrong = drape({"devices"}, {.environment = {"DRAPE_WITHOUT=depth"}});
    EXPECT_EQ(wrong.code, 4);
    EXPECT_THAT(wrong.err, HasSubstr("'depth' is nothing that a device may lack"));
}

TEST(Devices, AnUnknownOneInTheEnvironmentIsRefusedByWhateverNeedsADevice) {
    const SceneFolder folder(small_scene(2));
    for (const std::vector<std::string>& arguments :
         {std::vector<std::string>{"render", folder.scene(), "-o", folder.out()},
          {"simulate", folder.scene(), "-o", folder.out()},
          {"graph", folder.scene()},
          {"profile", folder.scene()},
          {"verify", folder.scene()},
          {"bench", "accuracy", folder.scene()}}) {
        const Outcome outcome = drape(arguments, {.environment = {"DRAPE_DEVICE=no such device"}});
        EXPECT_EQ(outcome.code, 4) << arguments[0];
        EXPECT_THAT(outcome.err, HasSubstr("DRAPE_DEVICE: no device matches \"no such device\"")) << arguments[0];
    }
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("scene.json"));
}

TEST(Devices, AnUnknownOneListsThoseThereAre) {
    const SceneFolder folder(small_scene(2));
    const std::string name = devices()[0]["name"].asString();
    for (const char* selector : {"99", "no such device", "00000000-0000-0000-0000-000000000000"}) {
        const Outcome outcome = drape({"render", folder.scene(), "-o", folder.out(), "--device", selector});
        EXPECT_EQ(outcome.code, 4) << selector;
        EXPECT_THAT(outcome.err, AllOf(HasSubstr(selector), HasSubstr("the devices are:\n  0: " + name))) << selector;
    }
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("scene.json"));
}

TEST(Devices, WithoutADriverTheErrorSaysWhereOneIs) {
    const SceneFolder folder(small_scene(2));
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"devices"},
                                                      {"graph", folder.scene()},
                                                      {"render", folder.scene(), "-o", folder.out()}}) {
        const Outcome outcome = drape(arguments, {.environment = no_driver});
        EXPECT_EQ(outcome.code, 4) << arguments[0];
        EXPECT_THAT(outcome.err, AllOf(HasSubstr("no Vulkan driver found"), HasSubstr("mesa-vulkan-drivers")));
        EXPECT_THAT(outcome.out, IsEmpty());
    }
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("scene.json"));
    // Commands that need no device work without one.
    EXPECT_EQ(drape({"check", folder.scene()}, {.environment = no_driver}).code, 0);
    EXPECT_EQ(drape({"schema"}, {.environment = no_driver}).code, 0);
}

TEST(Validation, AGoodSceneIsClean) {
    const SceneFolder folder(small_scene(3));
    const Outcome outcome = drape({"render", folder.scene(), "-o", folder.out(), "--validate"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.err, Not(HasSubstr("validation")));
    const Json::Value manifest = lasting_manifest(folder.out());
    EXPECT_TRUE(manifest["validation"]["enabled"].asBool());
    EXPECT_EQ(manifest["validation"]["messages"].asInt(), 0);
}

TEST(Validation, WithoutItsLayerIsAnError) {
    const SceneFolder folder(small_scene(2));
    const Outcome outcome = drape({"render", folder.scene(), "-o", folder.out(), "--validate"},
                                  {.environment = {"VK_LAYER_PATH=/nowhere"}});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.err, HasSubstr("the layer VK_LAYER_KHRONOS_validation is not installed"));
    EXPECT_THAT(names_in(folder.path()), testing::ElementsAre("scene.json"));
}

}  // namespace
}  // namespace drape
