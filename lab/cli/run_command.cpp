// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/run_command.hpp"

#include "lab/cli/files.hpp"
#include "lab/cli/host.hpp"
#include "lab/experiment/criteria_text.hpp"
#include "lab/experiment/text.hpp"
#include "lab/records/text_table.hpp"
#include "lab/results/manifest.hpp"
#include "lab/results/result_files.hpp"
#include "lab/runner/progress.hpp"
#include "lab/runner/runner.hpp"
#include "proto/base/version.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/result_file.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <filesystem>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <stdexcept>
#include <thread>
#include <utility>

namespace hapnet::lab {

namespace {

constexpr std::string_view program_name = "hapnet-lab";

/// Who plays: this very build. A session that any other build has played is not reused.
std::string program_identity()
{
    const auto binary = net::text_of_file("/proc/self/exe");
    const auto hash = binary ? base::Seed{}.stream(*binary).bits(0) : 0;
    return fmt::format("{} {:016x}", base::version_line(program_name), hash);
}

base::Result<experiment::Experiment> load(const RunCommand& command)
{
    experiment::Overrides overrides{command.quick, command.settings};
    if (command.seeds) overrides.settings.push_back(fmt::format("seeds={}", *command.seeds));
    return load_experiment(command.experiment, net::text_of_file, overrides);
}

void write_text(const std::filesystem::path& path, const std::string& text)
{
    create_folder(path.parent_path().string());
    net::ResultFile{path.string()}.commit(text);
}

/// A manifest without sessions beside it was written by something else.
base::Result<void> refuse_foreign(const std::filesystem::path& out)
{
    const bool has_sessions = std::filesystem::exists(out / "sessions.jsonl");
    if (has_sessions || !std::filesystem::exists(out / "manifest.json")) return {};
    return base::fail(fmt::format("--out: {} holds the results of something else: choose another "
                                  "folder, or remove it",
                                  out.string()));
}

/// The run of one experiment into one folder.
class ExperimentRun {
public:
    ExperimentRun(const RunCommand& command, experiment::Experiment experiment,
                  const metrics::Criteria& criteria)
        : command_{command},
          experiment_{std::move(experiment)},
          criteria_{criteria},
          out_{command.out},
          start_{net::monotonic_now()},
          start_s_{net::wall_clock_seconds()}
    {}

    base::Result<int> run()
    {
        net::StopSignal stop;
        auto foreign = refuse_foreign(out_);
        if (!foreign) return tl::unexpected{std::move(foreign).error()};
        create_folder(out_.string());
        const runner::FolderIdentity identity{std::string{name_of(experiment_.kind)},
                                              experiment_.title};
        const auto store = runner::SessionStore::open((out_ / "sessions.jsonl").string(), identity,
                                                      program_identity());
        if (!store) return base::fail("--out: " + store.error().message);
        if ((*store)->damaged_lines() > 0) {
            net::say(program_name,
                     fmt::format("{} lines of {} are damaged and left out",
                                 (*store)->damaged_lines(), (out_ / "sessions.jsonl").string()));
        }
        return run_with(**store, stop);
    }

private:
    base::Result<int> run_with(runner::SessionStore& store, net::StopSignal& stop)
    {
        runner::ProgressLine line{start_};
        const runner::Runner runner{store, runner::play_in_virtual_time, thread_count(),
                                    [&](const runner::RunProgress& progress) {
                                        line.show(progress, net::monotonic_now());
                                    }};
        const auto results = run_all(experiment_, criteria_, runner, stop);
        line.finish();
        if (!results) throw std::runtime_error{results.error().message};
        const auto counts = store.counts();
        if (!*results) {
            write_manifest(counts, {"stopped before its end"});
            net::say(program_name,
                     fmt::format("stopped; {} sessions are kept in {}: the same command goes on "
                                 "from there",
                                 counts.played + counts.reused, out_.string()));
            return net::exit_failed;
        }
        write_results(**results);
        write_manifest(counts, {});
        fmt::print("{}: {} sessions played, {} reused; results in {}\n", experiment_.title,
                   counts.played, counts.reused, out_.string());
        return 0;
    }

    void write_results(std::span<const experiment::JobResult> results) const
    {
        const auto files = results::make_result_files(experiment_, criteria_, results);
        if (!files) throw std::runtime_error{files.error().message};
        for (const results::File& file : *files) {
            write_text(out_ / file.path, file.text);
            if (file.path == "table1.csv" || file.path == "limits.csv") {
                fmt::print("{}\n", records::aligned(file.text));
            } else if (file.path == "criteria.toml") {
                fmt::print("{}\n", file.text);
            }
        }
    }

    [[nodiscard]] unsigned thread_count() const
    {
        return command_.jobs.value_or(std::max(std::thread::hardware_concurrency(), 1U));
    }

    void write_manifest(const runner::SessionStore::Counts& counts,
                        std::vector<std::string> invalid) const
    {
        const results::Circumstances circumstances{command_.command, results::utc_text(start_s_),
                                                   base::to_seconds(net::monotonic_now() - start_),
                                                   host(), base::version_line(program_name)};
        const results::RunOutcome outcome{print_criteria(criteria_), counts.played, counts.reused,
                                          std::move(invalid)};
        write_text(out_ / "manifest.json",
                   make_manifest(experiment_, circumstances, outcome).dump(2) + '\n');
    }

    const RunCommand& command_;
    experiment::Experiment experiment_;
    metrics::Criteria criteria_;
    std::filesystem::path out_;
    base::TimePoint start_;
    double start_s_;
};

} // namespace

base::Result<int> run_experiment(const RunCommand& command)
{
    auto experiment = load(command);
    if (!experiment) return tl::unexpected{experiment.error()};
    const auto criteria = experiment::load_criteria(command.criteria, net::text_of_file);
    if (!criteria) return tl::unexpected{criteria.error()};
    return ExperimentRun{command, *std::move(experiment), *criteria}.run();
}

} // namespace hapnet::lab
