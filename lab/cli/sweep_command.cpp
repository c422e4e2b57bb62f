// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/sweep_command.hpp"

#include "lab/cli/files.hpp"
#include "lab/cli/host.hpp"
#include "lab/cli/plan.hpp"
#include "lab/cli/run_command.hpp"
#include "lab/cli/session_records.hpp"
#include "lab/experiment/daemons.hpp"
#include "lab/metrics/exercise.hpp"
#include "lab/records/recorded_trace.hpp"
#include "lab/results/sweep.hpp"
#include "lab/results/table_text.hpp"
#include "lab/virtual_time/play.hpp"
#include "proto/base/version.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>
#include <utility>
#include <vector>

namespace hapnet::lab {

namespace {

namespace fs = std::filesystem;

constexpr const char* result_name = "result.json";

/// A session of the plan, and the known facts about its attempts.
struct Cell {
    const LoadedExperiment::Part* part;
    experiment::SessionJob job;
    fs::path folder;
    std::vector<results::PlayedCell> attempts{};

    [[nodiscard]] bool is_valid() const
    {
        return std::ranges::any_of(attempts, &results::PlayedCell::valid);
    }
    [[nodiscard]] fs::path attempt(std::size_t number) const
    {
        return folder / fmt::format("attempt-{}", number);
    }
};

struct Sweep {
    LoadedExperiment experiment;
    std::vector<Cell> cells;
};

/// Returns a name that is the same for the same session, whatever else an experiment has.
std::string name_of(const experiment::SessionJob& job)
{
    constexpr std::size_t digits = 16; // length of the hash at the end of a key
    const auto key = key_of(job.spec, base::version_line("hapnet"));
    return fmt::format("{}-{}-peers-seed-{}-{}", device::name_of(job.task),
                       job.spec.setting.players.size(), job.spec.setting.seed.value(),
                       key.substr(key.size() - digits));
}

base::Result<void> read_attempts(Cell& cell)
{
    for (std::size_t number = 1;; ++number) {
        const auto path = (cell.attempt(number) / result_name).string();
        if (!fs::exists(path)) return {};
        const auto json = read_json(path);
        if (!json) return tl::unexpected{json.error()};
        auto played = results::played_cell_from(*json);
        if (!played) {
            return base::fail(fmt::format("{}: not what `hapnet-lab real-time --played` writes: {}",
                                          path, played.error().message));
        }
        cell.attempts.push_back(*std::move(played));
    }
}

base::Result<Sweep> load_sweep(const std::string& folder)
{
    auto experiment = load_plan((fs::path{folder} / plan_name).string());
    if (!experiment) return tl::unexpected{experiment.error()};
    Sweep sweep{*std::move(experiment), {}};
    for (const LoadedExperiment::Part& part : sweep.experiment.parts) {
        auto sessions = daemon_sessions(part.experiment);
        if (!sessions) return tl::unexpected{sessions.error()};
        for (experiment::SessionJob& job : *sessions) {
            const auto path = fs::path{folder} / "cells" / name_of(job);
            sweep.cells.push_back({&part, std::move(job), path});
            if (auto read = read_attempts(sweep.cells.back()); !read)
                return tl::unexpected{read.error()};
        }
    }
    return sweep;
}

/// Returns the point of the axes, such as "hands.stiffness=100N/m"; empty: there are no axes.
std::string point_of(const LoadedExperiment& experiment, const LoadedExperiment::Part& part)
{
    std::vector<std::string> settings;
    for (std::size_t i = 0; i < part.values.size(); ++i)
        settings.push_back(fmt::format("{}={}", experiment.whole.axes[i].key, part.values[i]));
    return fmt::format("{}", fmt::join(settings, "; "));
}

/// Returns the next cell to play. The cell with the fewest attempts comes first: a busy machine may
/// be idle by then.
Cell* next_of(std::vector<Cell>& cells, std::uint32_t attempts)
{
    Cell* next = nullptr;
    for (Cell& cell : cells) {
        if (cell.is_valid() || cell.attempts.size() >= attempts) continue;
        if (next == nullptr || cell.attempts.size() < next->attempts.size()) next = &cell;
    }
    return next;
}

std::size_t peers_of(const results::SessionFiles& files)
{
    return std::max<std::size_t>(files.others.size(), 1) + 1;
}

/// Returns the metrics of a session in real time. All records are of that session.
base::Result<results::PlayedCell> played_in(const std::vector<record::Record>& records)
{
    std::vector<records::Session> sessions;
    for (std::size_t i = 1; i < records.size(); ++i) {
        auto session = records::common_session(records[0], records[i]);
        if (!session) return tl::unexpected{session.error()};
        sessions.push_back(*std::move(session));
    }
    results::PlayedCell played;
    played.real = metrics::metrics_of(records::trace_of(sessions));
    return played;
}

/// Returns the session on a perfect network, with even ticks.
virtual_time::Setting perfect(virtual_time::Setting setting)
{
    setting.profile = {};
    for (virtual_time::PlayerSetting& player : setting.players) player.ticks.reset();
    return setting;
}

/// Returns the reference for the session's scores.
base::Result<metrics::Metrics> reference_of(const virtual_time::Setting& setting)
{
    const auto unimpaired = play(perfect(setting));
    if (!unimpaired) return tl::unexpected{unimpaired.error()};
    auto metrics = metrics::metrics_of(*unimpaired);
    if (!metrics::exercise_of(setting.task).presses) return metrics;
    const auto one_world = play(in_one_world(setting));
    if (!one_world) return tl::unexpected{one_world.error()};
    return make_reference(std::move(metrics), metrics::metrics_of(*one_world));
}

base::Result<void> play_twins(const results::RealTimeSession& session, results::PlayedCell& played)
{
    const auto setting = twin_of(session, net::text_of_file);
    if (!setting) return tl::unexpected{setting.error()};
    const auto twin = play(*setting);
    if (!twin) return tl::unexpected{twin.error()};
    auto reference = reference_of(*setting);
    if (!reference) return tl::unexpected{std::move(reference).error()};
    played.simulated = metrics::metrics_of(*twin);
    played.perfect = *std::move(reference);
    return {};
}

std::string discrepancy_text(const metrics::Metrics& metrics)
{
    const auto& apart = metrics.discrepancy_m;
    return apart ? fmt::format("{:.3f} mm", 1e3 * apart->mean) : std::string{"no session"};
}

} // namespace

bool is_sweep(const std::string& folder)
{
    return fs::is_directory(fs::path{folder} / "cells") && fs::exists(fs::path{folder} / plan_name);
}

base::Result<std::string> next_session(const RealTimeCommand& command)
{
    auto sweep = load_sweep(command.folder);
    if (!sweep) return tl::unexpected{sweep.error()};
    create_folder((fs::path{command.folder} / "cells").string());
    const Cell* next = next_of(sweep->cells, command.attempts);
    if (next == nullptr) return std::string{};
    const auto attempt = next->attempts.size() + 1;
    const auto folder = next->attempt(attempt);
    fs::remove_all(folder);
    create_folder(folder.string());
    const virtual_time::Setting& setting = next->job.spec.setting;
    for (const experiment::ProgramFile& file : experiment::program_files(setting))
        disk::ResultFile{(folder / file.name).string()}.commit(file.text);
    const auto ended = std::ranges::count_if(sweep->cells, [&](const Cell& cell) {
        return cell.is_valid() || cell.attempts.size() >= command.attempts;
    });
    return fmt::format("{}\t{}\t{}\t{}\t{}\t{} of {}: {}, {}, seed {}, {}{}\n", folder.string(),
                       setting.players.size(), device::name_of(next->job.task),
                       setting.length / std::chrono::seconds{1}, setting.seed.value(), ended + 1,
                       sweep->cells.size(), next->job.spec.algorithm,
                       device::name_of(next->job.task), setting.seed.value(),
                       experiment::network_text(setting.profile),
                       attempt > 1 ? fmt::format(", attempt {}", attempt) : "");
}

base::Result<std::string> compare_session(const RealTimeCommand& command)
{
    const fs::path folder{command.played};
    results::RealTimeSession session{"loopback"};
    auto files = read_session_files(command.played);
    if (!files) return tl::unexpected{files.error()};
    session.files = *std::move(files);
    const auto records = records_in(command.played, peers_of(session.files));
    if (!records) return tl::unexpected{records.error()};
    session.ticks = ticks_in(*records);
    auto played = played_in(*records);
    if (!played) return base::fail(command.played + ": " + played.error().message);
    if (auto fine = play_twins(session, *played); !fine)
        return base::fail(command.played + ": " + fine.error().message);
    for (const auto& ticks : session.ticks) {
        const auto kept = results::kept_time(ticks);
        played->missed_ticks = std::max(played->missed_ticks, kept.missed);
        played->longest_gap_ms =
            std::max(played->longest_gap_ms, 1e3 * base::to_seconds(kept.longest_gap));
    }
    played->invalid_because = session.files.invalid_because();
    for (const std::string& stall : results::stalls_of(session))
        played->invalid_because.push_back(stall);
    if (!played->real.discrepancy_m)
        played->invalid_because.emplace_back("they were never in session together");
    disk::ResultFile{(folder / result_name).string()}.commit(to_json(*played).dump(2) + '\n');
    for (std::size_t id = 1; id <= records->size() && !command.keep_records; ++id)
        fs::remove(folder / fmt::format("peer-{}.rec", id));
    return fmt::format("mean {}, in virtual time {}{}{}\n", discrepancy_text(played->real),
                       discrepancy_text(played->simulated), played->valid() ? "" : "; NOT VALID: ",
                       fmt::join(played->invalid_because, "; "));
}

base::Result<std::string> conclude_sweep(const RealTimeCommand& command)
{
    const auto sweep = load_sweep(command.folder);
    if (!sweep) return tl::unexpected{sweep.error()};
    std::vector<results::SweepRow> rows;
    std::vector<results::RealTimeResult> noted;
    for (const Cell& cell : sweep->cells) {
        for (std::size_t i = 0; i < cell.attempts.size(); ++i) {
            rows.push_back(make_sweep_row(
                {cell.part->experiment, cell.job, point_of(sweep->experiment, *cell.part)},
                cell.attempts[i], sweep->experiment.criteria));
            rows.back().attempt = static_cast<std::uint32_t>(i + 1);
        }
        if (cell.attempts.empty()) continue;
        noted.push_back({.algorithm = cell.job.spec.algorithm,
                         .where = "loopback",
                         .real_mm = {},
                         .virtual_mm = {},
                         .invalid_because = cell.is_valid()
                                                ? std::vector<std::string>{}
                                                : cell.attempts.back().invalid_because});
    }
    if (rows.empty()) return base::fail(command.folder + " has no sessions that were played");
    const auto conditions = results::make_condition_rows(rows);
    write_result_tables(command.folder, results::real_time_name,
                        {sweep_table(rows), table_of("real_time_conditions", conditions)});
    const results::Circumstances circumstances{command.command, command.start, command.wall_time_s,
                                               host()};
    auto manifest = real_time_manifest(noted, circumstances);
    const auto fine = note_in_manifest(command.folder, std::move(manifest));
    if (!fine) return tl::unexpected{fine.error()};
    return conditions_table(conditions) +
           fmt::format("{} of {} sessions were played\n", noted.size(), sweep->cells.size());
}

} // namespace hapnet::lab
