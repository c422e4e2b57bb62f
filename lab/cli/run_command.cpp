// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/run_command.hpp"

#include "lab/cli/files.hpp"
#include "lab/cli/host.hpp"
#include "lab/experiment/criteria_text.hpp"
#include "lab/experiment/text.hpp"
#include "lab/records/kept_play.hpp"
#include "lab/records/text_table.hpp"
#include "lab/results/axis_files.hpp"
#include "lab/results/manifest.hpp"
#include "lab/results/result_files.hpp"
#include "lab/runner/progress.hpp"
#include "lab/runner/runner.hpp"
#include "proto/base/version.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/result_file.hpp"
#include "proto/net/text_file.hpp"
#include "proto/record/writer.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <stdexcept>
#include <thread>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::lab {

namespace {

constexpr std::string_view program_name = "hapnet-lab";

std::uint64_t hash_of_file(const std::string& path)
{
    const auto bytes = net::text_of_file(path);
    return bytes ? base::Seed{}.stream(*bytes).bits(0) : 0;
}

/// Who plays: this very build, and the algorithms that are no part of it. A session that any other
/// has played is not reused.
std::string program_identity(const experiment::Experiment& experiment)
{
    std::string identity =
        fmt::format("{} {:016x}", base::version_line(program_name), hash_of_file("/proc/self/exe"));
    for (const experiment::NamedAlgorithm& named : experiment.algorithms) {
        const auto* const own = std::get_if<peer::SharedObject>(&named.algorithm);
        if (own != nullptr) identity += fmt::format(" {:016x}", hash_of_file(own->options().file));
    }
    return identity;
}

experiment::Overrides overrides_of(const RunCommand& command)
{
    experiment::Overrides overrides{command.quick, command.settings};
    if (command.seeds) overrides.settings.push_back(fmt::format("seeds={}", *command.seeds));
    return overrides;
}

/// What an experiment is to find out: as it is stated, and at each value of its axis.
struct LoadedExperiment {
    experiment::Experiment whole;
    std::vector<experiment::AxisPoint> points;
};

base::Result<LoadedExperiment> load(const RunCommand& command)
{
    const auto overrides = overrides_of(command);
    auto whole = load_experiment(command.experiment, net::text_of_file, overrides);
    if (!whole) return tl::unexpected{whole.error()};
    auto points = load_axis_points(command.experiment, net::text_of_file, overrides);
    if (!points) return tl::unexpected{points.error()};
    auto loaded = load_own_algorithms(*whole);
    for (auto point = points->begin(); loaded && point != points->end(); ++point)
        loaded = load_own_algorithms(point->experiment);
    if (!loaded) return tl::unexpected{loaded.error()};
    return LoadedExperiment{*std::move(whole), *std::move(points)};
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
    ExperimentRun(const RunCommand& command, LoadedExperiment loaded,
                  const metrics::Criteria& criteria)
        : command_{command},
          experiment_{std::move(loaded.whole)},
          points_{std::move(loaded.points)},
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
                                                      program_identity(experiment_));
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
        std::vector<results::AxisFiles> found;
        for (const experiment::AxisPoint& point : points_) {
            const auto files = files_of(point, store, stop);
            if (!files) return stopped(store);
            found.push_back({point.value, *files});
        }
        const auto counts = store.counts();
        write_results(experiment_.axis ? joined_by_axis(experiment_.axis->key, found)
                                       : std::move(found.front().files));
        write_manifest(counts, {});
        fmt::print("{}: {} sessions played, {} reused; results in {}\n", experiment_.title,
                   counts.played, counts.reused, out_.string());
        return 0;
    }

    /// nullopt: it was stopped.
    std::optional<std::vector<results::File>> files_of(const experiment::AxisPoint& point,
                                                       runner::SessionStore& store,
                                                       net::StopSignal& stop) const
    {
        runner::ProgressLine line{start_};
        const runner::Runner runner{store, runner::play_in_virtual_time, thread_count(),
                                    [&](const runner::RunProgress& progress) {
                                        line.show(progress, net::monotonic_now());
                                    }};
        const auto results = run_all(point.experiment, criteria_, runner, stop);
        line.finish();
        if (!results) throw std::runtime_error{results.error().message};
        if (!*results) return std::nullopt;
        if (point.experiment.record) write_records(point);
        auto files = results::make_result_files(point.experiment, criteria_, **results);
        if (!files) throw std::runtime_error{files.error().message};
        return *std::move(files);
    }

    /// records/[VALUE/]ALGORITHM-TASK/peer-N.rec of the sessions of the first seed.
    void write_records(const experiment::AxisPoint& point) const
    {
        for (const experiment::Job& job : make_jobs(point.experiment)) {
            const auto* one = std::get_if<experiment::SessionJob>(&job);
            const bool is_first =
                one != nullptr && one->spec.setting.seed.value() == point.experiment.first_seed;
            if (!is_first) continue;
            const auto kept = records::play_and_keep(one->spec.setting);
            if (!kept) throw std::runtime_error{kept.error().message};
            const auto name = fmt::format("{}-{}", point.experiment.algorithms[one->algorithm].name,
                                          name_of(one->task));
            const auto folder = out_ / "records" / point.value / name;
            create_folder(folder.string());
            for (std::size_t seat = 0; seat < kept->size(); ++seat) {
                const records::KeptRecord& of_player = (*kept)[seat];
                const auto path = folder / fmt::format("peer-{}.rec", seat + 1);
                record::Writer writer{path.string(), of_player.config, of_player.layout};
                for (const record::Row& row : of_player.rows) writer.write(row);
                writer.flush();
            }
        }
    }

    int stopped(const runner::SessionStore& store) const
    {
        const auto counts = store.counts();
        write_manifest(counts, {"stopped before its end"});
        net::say(program_name,
                 fmt::format("stopped; {} sessions are kept in {}: the same command goes on from "
                             "there",
                             counts.played + counts.reused, out_.string()));
        return net::exit_failed;
    }

    void write_results(const std::vector<results::File>& files) const
    {
        for (const results::File& file : files) {
            write_text(out_ / file.path, file.text);
            if (file.path == "table1.csv" || file.path.starts_with("limits.") ||
                file.path == "limits_by_axis.csv") {
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
    std::vector<experiment::AxisPoint> points_;
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
