// `drape sweep` makes many runs of a scene, each with values of its own.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <map>
#include <set>
#include <thread>

#include "base/output_error.h"
#include "base/printable_text.h"
#include "ending.h"
#include "options.h"
#include "output/atomic_file.h"
#include "program.h"
#include "streams.h"
#include "sweep/bound.h"
#include "sweep/groups.h"
#include "sweep/local_runs.h"

namespace drape::cli {

namespace {

struct SweepOptions {
    std::string spec, output;
    std::vector<std::string> devices;
    std::string device(std::size_t process = 0) const {
        return devices.empty() ? std::string() : devices[process % devices.size()];
    }
    std::vector<std::string> formats;  ///< none: the data set's alone, or npz
    bool deflates = false, pictures = false;
    std::optional<std::string> indices;
    std::uint32_t jobs = 0;
    bool dataset = false, resume = false, collect = false, list = false, count = false, quiet = false;
};

/// Parses the runs of a job: "7", "0-99", "1,5,9-12". Each counts once.
std::vector<std::uint32_t> parse_indices(const std::string& text, std::uint32_t count) {
    std::vector<std::uint32_t> indices;
    std::vector<bool> taken(count);
    const auto wrong = [&] {
        return UsageError(
            fmt::format("--index: expected runs from 0 to {}, as in 7, 0-99 or 1,5,9-12, got '{}'", count - 1, text));
    };
    const char *at = text.data(), *end = text.data() + text.size();
    const auto number = [&] {
        std::uint32_t value = 0;
        const auto [next, error] = std::from_chars(at, end, value);
        if (error != std::errc{} || value >= count) throw wrong();
        at = next;
        return value;
    };
    for (;;) {
        const std::uint32_t first = number();
        const bool is_range = at != end && *at == '-';
        if (is_range) ++at;
        const std::uint32_t last = is_range ? number() : first;
        if (last < first) throw wrong();
        for (std::uint32_t index = first; index <= last; ++index) {
            if (!taken[index]) indices.push_back(index);
            taken[index] = true;
        }
        if (at == end) return indices;
        if (*at++ != ',') throw wrong();
    }
}

RunRequest request_of(const SweepOptions& options, const sweep::SweepSpec& spec, const sweep::SweepFolder& folder,
                      std::uint32_t index) {
    RunRequest request;
    request.scene.path = spec.scene;
    request.scene.overrides = spec.overrides_of(index);
    request.scene.device = options.device();
    request.output = folder.run_folder(index).string();
    request.existing = ExistingFiles::overwrite;
    request.formats = options.formats;
    constexpr const char* trajectory = "mgn";
    if (options.dataset && std::ranges::find(request.formats, trajectory) == request.formats.end())
        request.formats.emplace_back(trajectory);
    if (request.formats.empty()) request.formats = {"npz"};
    if (options.pictures) request.formats.emplace_back("png");
    request.deflates = options.deflates;
    request.quiet = true;
    request.message = print_message;
    request.stop = stop_requested;
    request.saving = take_time;
    return request;
}

DeviceKind device_kind_of(const SweepOptions& options) {
    return Device(options.device()).info().type == "cpu" ? DeviceKind::cpu : DeviceKind::gpu;
}

/// Makes runs here and writes their records.
class RunsHere {
  public:
    RunsHere(const SweepOptions& options, const sweep::SweepSpec& spec, const sweep::SweepFolder& folder)
        : options_(options), spec_(spec), folder_(folder), asked_(parse_indices(*options.indices, spec.count)) {}

    /// Makes those of a list that go on together. Returns false where some were stopped.
    bool make(const std::vector<sweep::GroupedRun>& group) {
        begun_ = std::chrono::steady_clock::now();
        if (group.size() == 1)
            end(group.front().index, run_alone(group.front()));
        else
            make_together(group);
        if (unwritten_ && group.size() == 1) std::rethrow_exception(unwritten_->error);
        if (unwritten_)
            throw OutputError(fmt::format("run {}: {}", unwritten_->index, failure_of(unwritten_->error).text));
        return stopped_.empty();
    }
    /// Returns the exit code of the run that was asked for, or of several: whether one has failed.
    ExitCode code() const { return worst_ != ExitCode::ok && several() ? ExitCode::sweep : worst_; }
    std::string stopped() const { return stopped_; }

    /// Returns the runs of --index that have no record, as lists.
    std::vector<std::vector<sweep::GroupedRun>> lists() {
        std::vector<sweep::GroupedRun> runs;
        for (const std::uint32_t index : asked_) {
            if (const auto there = options_.resume ? folder_.record(index) : std::nullopt)
                note(static_cast<ExitCode>(there->exit_code));
            else
                runs.push_back({index, request_of(options_, spec_, folder_, index)});
        }
        std::vector<std::vector<sweep::GroupedRun>> groups =
            sweep::groups_of(std::move(runs), device_kind_of(options_));
        for (std::vector<sweep::GroupedRun>& group : groups)
            for (sweep::GroupedRun& run : group)
                if (several())
                    run.request.message = [this, index = run.index](const std::string& text) { tell(index, text); };
        return groups;
    }

  private:
    bool several() const { return asked_.size() > 1; }
    /// Messages of several runs are mixed; each run's file has its own.
    void tell(std::uint32_t index, const std::string& text) {
        logs_[index] += printable(text) + "\n";
        print_message(fmt::format("run {}: {}", index, text));
    }
    /// Makes those alone that the device could not take together with others.
    void make_together(const std::vector<sweep::GroupedRun>& group) {
        std::set<std::size_t> ended;
        std::vector<RunRequest> requests;
        for (const sweep::GroupedRun& run : group) requests.push_back(run.request);
        try {
            run_scenes_together(requests, [&](const RunEnd& run) {
                ended.insert(run.number);
                end(group[run.number].index, run);
            });
        } catch (const DeviceError&) {
            for (std::size_t k = 0; k < group.size(); ++k)
                if (!ended.contains(k)) end(group[k].index, run_alone(group[k]));
        }
    }
    static RunEnd run_alone(const sweep::GroupedRun& run) {
        try {
            return {0, run_scene(run.request).complete, nullptr};
        } catch (...) {
            return {0, false, std::current_exception()};
        }
    }
    void note(ExitCode code) {
        if (code != ExitCode::ok) worst_ = code;
    }
    void end(std::uint32_t index, const RunEnd& run) {
        sweep::JobRecord record;
        record.index = index;
        std::string failed;
        if (run.failure) {
            const Failure failure = failure_of(run.failure);
            // A full disk says nothing about the run: without a record --resume runs it again.
            if (failure.code == ExitCode::io) {
                return leave_unwritten({index, run.failure});
            }
            record.exit_code = static_cast<int>(failure.code);
            record.message = failure.text;
            failed = fmt::format("run {}: {}", index, failure.text);
            print_error(failed);
        } else if (!run.complete) {
            if (stopped_.empty()) stopped_ = fmt::format("run {} left no record", index);
            return;
        }
        record.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
        try {
            if (several()) write_log(index, failed);
            folder_.write(record, options_.dataset);
        } catch (const OutputError&) {
            return leave_unwritten({index, std::current_exception()});
        }
        note(static_cast<ExitCode>(record.exit_code));
    }
    /// Leaves what a process of the run's own would say.
    void write_log(std::uint32_t index, const std::string& failed) {
        const std::string text = logs_[index] + (failed.empty() ? "" : "drape: " + printable(failed) + "\n");
        if (!text.empty()) write_file(folder_.log_file(index), text);
    }
    struct Unwritten {
        std::uint32_t index;
        std::exception_ptr error;
    };
    void leave_unwritten(const Unwritten& run) {
        if (!unwritten_ || run.index < unwritten_->index) unwritten_ = run;
    }
    static Failure failure_of(const std::exception_ptr& error) {
        try {
            std::rethrow_exception(error);
        } catch (...) {
            return current_failure();
        }
    }

    const SweepOptions& options_;
    const sweep::SweepSpec& spec_;
    const sweep::SweepFolder& folder_;
    std::vector<std::uint32_t> asked_;
    std::chrono::steady_clock::time_point begun_;
    std::map<std::uint32_t, std::string> logs_;
    ExitCode worst_ = ExitCode::ok;
    std::string stopped_;                 ///< the first run that was
    std::optional<Unwritten> unwritten_;  ///< the first run with a file that could not be written
};

/// Makes the runs of --index, those of one shape together.
ExitCode run_indices(const SweepOptions& options, const sweep::SweepSpec& spec, const sweep::SweepFolder& folder) {
    sweep::end_with_sweep();
    RunsHere runs(options, spec, folder);
    for (const std::vector<sweep::GroupedRun>& group : runs.lists())
        if (!runs.make(group)) return report_stop(runs.stopped());
    if (options.dataset) folder.describe_dataset();
    return runs.code();
}

std::vector<std::string> command_of(const SweepOptions& options, const std::vector<std::uint32_t>& indices,
                                    std::size_t process) {
    std::vector<std::string> command{
        "drape", "sweep", options.spec, "-o", options.output, "--index", fmt::format("{}", fmt::join(indices, ","))};
    if (!options.devices.empty()) command.insert(command.end(), {"--device", options.device(process)});
    if (options.dataset) command.emplace_back("--dataset");
    if (options.deflates) command.emplace_back("--compress");
    if (options.pictures) command.emplace_back("--pictures");
    if (!options.formats.empty())
        command.insert(command.end(), {"--export", fmt::format("{}", fmt::join(options.formats, ","))});
    return command;
}

ExitCode conclude(const SweepOptions& options, const sweep::SweepFolder& folder) {
    const sweep::Tally tally = folder.collect(options.dataset);
    if (!options.quiet || !tally.complete())
        print_message(fmt::format("{}; {}", tally.text(), printable((folder.path() / "results.csv").string())));
    return tally.complete() ? ExitCode::ok : ExitCode::sweep;
}

/// Returns how many runs a process makes, where they go on together. On a CPU more than some gain nothing, and their
/// files come late; a GPU has room for many, and a process for each core keeps it fed.
std::size_t group_size(DeviceKind device, std::size_t runs, std::size_t processes) {
    const std::size_t most = device == DeviceKind::cpu ? 16 : sweep::most_grouped;
    return std::clamp<std::size_t>((runs + processes - 1) / processes, 1, most);
}

std::vector<std::vector<std::uint32_t>> shares_of(const std::vector<std::uint32_t>& indices, std::size_t size) {
    std::vector<std::vector<std::uint32_t>> shares;
    for (const std::uint32_t index : indices) {
        if (shares.empty() || shares.back().size() == size) shares.emplace_back();
        shares.back().push_back(index);
    }
    return shares;
}

ExitCode run_all(const SweepOptions& options, const sweep::SweepSpec& spec, const sweep::SweepFolder& folder,
                 std::uint32_t good) {
    folder.remove_logs_of_processes();
    sweep::LocalRuns runs;
    runs.processes = options.jobs > 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::uint32_t> missing;
    for (std::uint32_t index = 0; index < spec.count; ++index)
        if (!folder.record(index)) missing.push_back(index);
    const DeviceKind device = device_kind_of(options);
    runs.groups = shares_of(missing, sweep::can_be_grouped(request_of(options, spec, folder, good), device)
                                         ? group_size(device, missing.size(), runs.processes)
                                         : 1);
    // Where every core has a run, a driver's own threads would only be in the way.
    if (runs.processes > 1) setenv("LP_NUM_THREADS", "0", 0);
    std::size_t process = 0;
    runs.command = [&](const std::vector<std::uint32_t>& indices) { return command_of(options, indices, process++); };
    runs.stop = stop_requested;
    runs.quiet = options.quiet;
    runs.dataset = options.dataset;
    const sweep::Occupancy occupancy(std::max(1u, std::thread::hardware_concurrency()));
    if (!sweep::run_locally(runs, folder)) return report_stop("--resume goes on");
    if (const std::string bound = occupancy.text(); !options.quiet && !bound.empty()) print_message(bound);
    return conclude(options, folder);
}

std::string list(const sweep::SweepSpec& spec) {
    std::string text;
    for (std::uint32_t index = 0; index < spec.count; ++index) {
        text += fmt::format("{}", index);
        for (const auto& [pointer, value] : spec.parameters_of(index)) text += fmt::format("\t{}={}", pointer, value);
        text += "\n";
    }
    return text;
}

/// Returns the first run whose scene is good, among some of the first. A scene of which none is good is told before the
/// first run.
std::uint32_t check_scene(const sweep::SweepSpec& spec, bool dataset) {
    constexpr std::uint32_t most_looked_at = 16;
    std::optional<SceneResult> bad;
    for (std::uint32_t index = 0; index < std::min(spec.count, most_looked_at); ++index) {
        SceneResult result = read_scene(spec.scene, spec.overrides_of(index));
        if (!result.scene) {
            if (!bad) bad = std::move(result);
            continue;
        }
        if (dataset && result.scene->comes_apart())
            throw UsageError(fmt::format("--dataset: the cells of a trajectory cannot change, but the scene has {}",
                                         result.scene->tears() ? "cloth that tears" : "cutters"));
        return index;
    }
    throw SceneFailure(std::move(*bad));
}

/// A data set cannot be made of runs that are done without their trajectories.
void check_trajectories(const sweep::SweepSpec& spec, const sweep::SweepFolder& folder) {
    for (std::uint32_t index = 0; index < spec.count; ++index)
        if (const auto there = folder.record(index); there && there->done() && !folder.has_trajectory(index))
            throw UsageError(
                fmt::format("--dataset: run {} of '{}' was made without it and has no trajectory: make "
                            "the data set in another folder",
                            index, folder.path().string()));
}

ExitCode run(const SweepOptions& options) {
    const sweep::SweepSpec spec = sweep::read_sweep(options.spec);
    if (options.count || options.list) {
        print_data(options.count ? fmt::format("{}\n", spec.count) : list(spec));
        return ExitCode::ok;
    }
    if (options.output.empty()) throw UsageError("sweep: --output is required");
    if (options.indices) parse_indices(*options.indices, spec.count);  // it is wrong before anything is made
    const std::uint32_t good = check_scene(spec, options.dataset);
    const bool fresh = !options.indices && !options.resume && !options.collect;
    const sweep::SweepFolder folder(options.output, spec, fresh);
    if (options.dataset && !options.indices) check_trajectories(spec, folder);
    catch_signals(!options.indices);
    if (options.collect) return conclude(options, folder);
    return options.indices ? run_indices(options, spec, folder) : run_all(options, spec, folder, good);
}

constexpr const char* details = R"text(
SPEC is JSON, with // comments:
  {"scene": "flag.json", "seed": 1, "count": 1000,
   "set": {"/time/frames": 401},
   "vary": {"/wind/velocity/0": {"uniform": [2, 8]},
            "/cloths/0/stiffness/bend": {"log_uniform": [1e-6, 1e-4]},
            "/cloths/0/areal_density": {"normal": [0.2, 0.05],
                                        "within": [0.1, 0.4]},
            "/wind/gust/seed": {"integer": [0, 1000000]},
            "/cloths/0/fabric": {"choice": ["cotton", "silk"]},
            "/cloths/0/damping": {"grid": [0.1, 0.2, 0.4]}}}
The values of run I follow from SPEC and I alone, each pointer's from a random
number of its own: --index I anywhere gives the bytes that the whole sweep
gives. Grids are counted through, the last pointer in alphabetical order
fastest; without a count every combination runs once.

Runs of one shape share a process and its dispatches, where they gain by it.

DIR gets runs/0000/ (as of `drape simulate`), jobs/0000.json (how it ended) and
results.csv, a line per run, failed ones too: exit code 9 when there is one
(a single run of --index ends with its own); no text in it is a control
character or, to a spreadsheet, a formula. A file that a run cannot read or
write ends the sweep with exit code 1; that run has no record, and --resume runs
it.

Examples:
  drape sweep spec.json -o out/sweep              all cores
  drape sweep spec.json -o out/sweep --resume     after an interruption
  drape sweep spec.json -o out/data --dataset     layout of flag_simple
  drape sweep spec.json -o out/sweep --index 17   one run, on any machine
  drape sweep spec.json -o out/sweep --collect    results.csv of what is there
  drape sweep spec.json -o out/data --dataset --index 0-99   a share
  drape sweep spec.json -o out/data --dataset --collect      and its meta.json
)text";

}  // namespace

void add_sweep(Program& program) {
    const auto options = std::make_shared<SweepOptions>();
    CLI::App& command = program.add("sweep", "Run a scene many times, with values drawn from a seed", details,
                                    [=] { return run(*options); });
    add_required_file(command, "SPEC", "What changes from run to run, as below", options->spec);
    add_option(command, "-o,--output", "DIR", "Folder for all runs, made when missing", options->output);
    add_option(command, "--index", "I,...", "Only these runs, here: 7, 0-99 or 1,5,9-12",
               [options](const std::string& text) {
                   options->indices = text;
                   return std::string();
               });
    add_option(command, "--jobs", "N", "Processes at a time; default: one per core", whole(1, options->jobs));
    add_format_option(command, "What each run writes; default: npz, with --dataset nothing more", options->formats);
    add_compress_option(command, options->deflates);
    add_flag(command, "--pictures", "Each run draws its pictures too, in a process of its own", options->pictures);
    add_flag(command, "--dataset",
             "The layout of MeshGraphNets' flag_simple, beside what --export says: dataset/meta.json and a trajectory "
             "per run",
             options->dataset);
    add_flag(command, "--resume", "Go on with a sweep: runs with a record are kept, failed ones too", options->resume);
    add_flag(command, "--collect", "Run nothing: results.csv of the records, with --dataset meta.json too",
             options->collect);
    add_flag(command, "--list", "Print every run's values", options->list);
    add_flag(command, "--count", "Print the number of runs", options->count);
    add_devices_option(command, options->devices);
    add_flag(command, "-q,--quiet", "No progress", options->quiet);
}

}  // namespace drape::cli
