#include "run/verify.h"

#include "base/printable_text.h"
#include "ending.h"
#include "options.h"
#include "output/atomic_file.h"
#include "program.h"
#include "streams.h"

namespace drape::cli {

namespace {

struct VerifyOptions {
    std::vector<std::string> paths;
    verify::Request request;
    bool json = false, quiet = false, no_validation = false;
    std::string junit;
};

ExitCode run(VerifyOptions options) {
    catch_signals();
    options.request.stop = stop_requested;
    options.request.validate = !options.no_validation;
    std::vector<verify::Report> reports;
    ExitCode code = ExitCode::ok;
    for (const std::string& path : scene_files(options.paths)) {
        verify::Report report = verify::verify_scene(path, options.request);
        if (report.stopped || stop_requested())
            return report_stop(printable(path) + " and what came after it were not judged");
        if (!options.json && !(options.quiet && report.met())) print_data(verify::report_text(report));
        if (!report.errors.empty())
            code = report.unreadable || code == ExitCode::io ? ExitCode::io : ExitCode::scene;
        else if (!report.met() && code == ExitCode::ok)
            code = ExitCode::comparison;
        reports.push_back(std::move(report));
    }
    if (options.json) print_data(verify::reports_json(reports));
    if (!options.junit.empty()) write_file(options.junit, verify::reports_junit(reports));
    return code;
}

}  // namespace

void add_verify(Program& program) {
    const auto options = std::make_shared<VerifyOptions>();
    verify::Request& request = options->request;
    CLI::App& command = program.add("verify", "Run scenes and judge them by what their files promise", R"text(
Runs every scene to its end, without pictures, under validation, and judges: its oracles (`drape schema --markdown`
lists them), that every frame is finite, plausible and within the scene's tolerance, the limits given here, and that
the validation layer said nothing. Where the position error is estimated (method auto, solver.estimate_error) it judges
the motion too: the worst frame's error against what solver.tolerance_motion allows by then, of which simulate and
render only warn. Exit code 7 when anything is missed.

Examples:
  drape verify scenes/flag.json
  drape verify scenes/*.json --junit verify.xml
  drape verify my.json --penetration 1e-4 --stretch 0.05 --json
)text",
                                    [=] { return run(*options); });
    add_scene_list(command, options->paths);
    add_override_option(command, request.overrides);
    add_device_option(command, request.device);
    add_option(command, "--stretch", "STRAIN", "Largest RMS strain of a cloth's stretch springs in any frame",
               not_negative(request.stretch));
    add_option(command, "--stretch-error", "ERROR",
               "Largest RMS stretch error likewise; default: the scene's tolerance, where it has one, or method auto's",
               not_negative(request.stretch_error));
    add_option(command, "--penetration", "METRES", "Largest depth of a particle in the zone that contact keeps free",
               not_negative(request.penetration));
    add_option(command, "--junit", "FILE", "Also as JUnit's XML", options->junit);
    add_flag(command, "--no-validate", "Without the validation layer, in less time", options->no_validation);
    add_flag(command, "--json", "As JSON on stdout instead of text", options->json);
    add_flag(command, "-q,--quiet", "Say nothing about scenes that meet everything", options->quiet);
}

}  // namespace drape::cli
