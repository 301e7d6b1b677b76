// The options that several commands share, with their help texts and checks.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "bench/accuracy.h"
#include "drape.h"

namespace drape::cli {

/// --set
void add_override_option(CLI::App& command, std::vector<std::string>& overrides);
/// --device
void add_device_option(CLI::App& command, std::string& device);
/// --validate
void add_validate_option(CLI::App& command, bool& validate);
/// SCENE, --set, --device, --validate, --no-skip
void add_scene_options(CLI::App& command, SceneRequest& scene);
/// --size, --samples
void add_image_options(CLI::App& command, SceneRequest& scene);
/// Those of add_scene_options and where, which frames, how talkative
void add_run_options(CLI::App& command, RunRequest& request);
/// Those of `bench accuracy`
void add_accuracy_options(CLI::App& command, bench::AccuracyRequest& request);

}  // namespace drape::cli
