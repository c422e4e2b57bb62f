// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/experiment_run.hpp"

#include "lab/cli/files.hpp"
#include "lab/cli/host.hpp"
#include "lab/records/kept_play.hpp"
#include "lab/results/found.hpp"
#include "lab/results/manifest.hpp"
#include "lab/results/precision_table.hpp"
#include "lab/results/ranking_table.hpp"
#include "lab/results/table_text.hpp"
#include "lab/runner/checksums.hpp"
#include "lab/runner/progress.hpp"
#include "lab/runner/result_tables.hpp"
#include "lab/runner/runner.hpp"
#include "proto/base/version.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"
#include "proto/record/writer.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <stdexcept>
#include <utility>
#include <variant>

namespace hapnet::lab {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view program_name = "hapnet-lab";

runner::FolderIdentity identity_of(const LoadedExperiment& experiment)
{
    return {std::string{name_of(experiment.whole.kind)}, experiment.whole.title};
}

void write_text(const fs::path& path, const std::string& text)
{
    create_folder(path.parent_path().string());
    disk::ResultFile{path.string()}.commit(text);
}

void tell_of_damage(const runner::SessionStore& store)
{
    const auto damage = store.damage();
    if (!damage) return;
    net::say(program_name, fmt::format("{}; left out", *damage));
}

/// Returns the folder of a point's records: "5ms" of one axis, or "point-3"; empty: no axes.
std::string name_of_point(const LoadedExperiment::Part& part)
{
    if (part.values.empty()) return {};
    const bool is_name =
        part.values.size() == 1 && part.values.front().find('/') == std::string::npos;
    return is_name ? part.values.front() : fmt::format("point-{}", part.point + 1);
}

/// Returns the cells that come before the cells of each row in a table. They name the row's point
/// of the axes.
std::vector<results::LeadingCell> leading_cells(const std::vector<experiment::Axis>& axes,
                                                const LoadedExperiment::Part& part)
{
    if (axes.empty()) return {};
    if (axes.size() == 1) return {{"parameter", axes.front().key}, {"value", part.values.front()}};
    std::vector<results::LeadingCell> cells{{"point", results::to_cell(part.point + 1)}};
    for (std::size_t i = 0; i < axes.size(); ++i) cells.push_back({axes[i].key, part.values[i]});
    return cells;
}

/// Writes records/[POINT/]ALGORITHM-TASK/peer-N.rec of the sessions of the first seed; for people,
/// of their first trial.
void write_records(const fs::path& out, const LoadedExperiment::Part& part)
{
    const experiment::Experiment& experiment = part.experiment;
    for (const experiment::Job& job : make_jobs(experiment)) {
        const auto* one = std::get_if<experiment::SessionJob>(&job);
        const bool is_first = one != nullptr && one->trial == 0 &&
                              one->spec.setting.seed.value() == experiment.first_seed;
        if (!is_first) continue;
        const auto kept = records::play_and_keep(one->spec.setting);
        if (!kept) throw std::runtime_error{kept.error().message};
        const auto name =
            fmt::format("{}-{}", experiment.algorithms[one->algorithm].name, name_of(one->task));
        const auto folder = out / "records" / name_of_point(part) / name;
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

/// Returns the jobs of a part that belong to the shard.
std::vector<experiment::Job> jobs_of(const LoadedExperiment::Part& part,
                                     experiment::ShardDeal& deal)
{
    std::vector<experiment::Job> jobs;
    for (experiment::Job& job : make_jobs(part.experiment)) {
        if (deal.takes(job)) jobs.push_back(std::move(job));
    }
    return jobs;
}

experiment::ShardDeal deal_of(const LoadedExperiment& experiment, const experiment::Shard& shard)
{
    return {shard, make_jobs(experiment.parts.front().experiment)};
}

/// Runs the jobs of a shard, some parts at a time.
class ShardRun {
public:
    using Results = std::vector<experiment::JobResult>;
    /// Uses the results of the jobs of a part.
    using UseResults = std::function<void(const LoadedExperiment::Part&, const Results&)>;

    ShardRun(const LoadedExperiment& experiment, const experiment::Shard& shard,
             runner::Runner runner)
        : experiment_{experiment},
          shard_{shard},
          runner_{std::move(runner)},
          line_{net::monotonic_now()}
    {
        auto deal = deal_of(experiment, shard);
        for (const auto& part : experiment.parts) total_ += jobs_of(part, deal).size();
        runner_.on_progress = [this](const runner::RunProgress& progress) {
            line_.show({total_, done_ + progress.jobs_done, progress.sessions},
                       net::monotonic_now());
        };
    }

    [[nodiscard]] std::size_t jobs() const { return total_; }

    /// Runs all jobs of the shard. Returns false when it was stopped.
    base::Result<bool> run(const UseResults& use)
    {
        auto deal = deal_of(experiment_, shard_);
        const auto& parts = experiment_.parts;
        for (auto part = parts.begin(); part != parts.end();) {
            std::vector<runner::Assignment> jobs;
            std::vector<std::size_t> counts; // number of jobs of each part in this batch
            const auto first = part;
            for (; part != parts.end() && jobs.size() < batch; ++part) {
                auto more = jobs_of(*part, deal);
                counts.push_back(more.size());
                for (experiment::Job& job : more)
                    jobs.push_back({&part->experiment, std::move(job)});
            }
            auto results = run_all(jobs, experiment_.criteria, runner_, stop_);
            if (!results) return tl::unexpected{results.error()};
            if (!*results) return false;
            done_ += jobs.size();
            auto next = std::make_move_iterator((*results)->begin());
            for (std::size_t i = 0; i < counts.size(); ++i) {
                const auto end = next + static_cast<std::ptrdiff_t>(counts[i]);
                use(first[static_cast<std::ptrdiff_t>(i)], Results(next, end));
                next = end;
            }
        }
        line_.finish();
        return true;
    }

private:
    static constexpr std::size_t batch = 1000; // jobs; threads wait for one another after each

    const LoadedExperiment& experiment_;
    experiment::Shard shard_;
    runner::Runner runner_;
    runner::ProgressLine line_;
    net::StopSignal stop_;
    std::size_t total_ = 0;
    std::size_t done_ = 0;
};

/// Collects the findings of an experiment for a folder.
class ResultFolder {
public:
    ResultFolder(const LoadedExperiment& experiment, const RunPlace& place)
        : experiment_{experiment},
          place_{place},
          out_{place.out},
          tables_{out_},
          start_{net::monotonic_now()},
          start_s_{net::wall_clock_seconds()}
    {}

    void add(const LoadedExperiment::Part& part, const ShardRun::Results& found)
    {
        forget_old_checksums();
        if (part.experiment.record) write_records(out_, part);
        if (has_reference() || ranks_hands())
            findings_.push_back({part.values.front(), &part.experiment, found});
        auto results = results::find_results(part.experiment, experiment_.criteria, found);
        if (!results) throw std::runtime_error{results.error().message};
        for (results::Table& table : results->tables) add(part, std::move(table));
        if (!experiment_.whole.axes.empty()) return;
        for (const results::File& file : results->files) {
            write_text(out_ / file.path, file.text);
            names_.push_back(file.path);
            shown_ += file.text + '\n';
        }
    }

    /// Moves all files into place. Returns the digest.
    std::string finish(const runner::SessionStore::Counts& counts)
    {
        forget_old_checksums();
        if (has_reference()) {
            const auto& axis = experiment_.whole.axes.front();
            tables_.add(results::precision_table(axis, findings_, experiment_.criteria));
        }
        if (ranks_hands()) {
            const auto& axis = experiment_.whole.axes.front();
            tables_.add(results::ranking_table(axis, findings_, experiment_.criteria));
        }
        for (std::string& name : tables_.commit()) names_.push_back(std::move(name));
        const auto checksums = runner::checksums_of(out_, names_);
        write_text(out_ / runner::checksums_name, checksums);
        auto digest = runner::checksum_of(checksums);
        write_manifest(counts, {}, digest);
        for (const results::Table& table : short_) shown_ += aligned_text(table) + '\n';
        net::print(shown_);
        return digest;
    }

    void write_manifest(const runner::SessionStore::Counts& counts,
                        std::vector<std::string> invalid, const std::string& digest = {}) const
    {
        const results::Circumstances circumstances{place_.command,
                                                   results::utc_text(start_s_),
                                                   base::to_seconds(net::monotonic_now() - start_),
                                                   host(),
                                                   base::version_line(program_name),
                                                   base::to_seconds(net::program_processor_time())};
        results::RunOutcome outcome{print_criteria(experiment_.criteria), counts.played,
                                    counts.reused, std::move(invalid), digest};
        for (const LoadedExperiment::Part& part : experiment_.parts)
            if (part.experiment.hands.people) outcome.people = part.experiment.hands.people;
        write_text(out_ / "manifest.json",
                   make_manifest(experiment_.whole, circumstances, outcome).dump(2) + '\n');
    }

private:
    /// Removes the checksums of an earlier run, which become invalid as soon as a file is written.
    void forget_old_checksums()
    {
        if (!std::exchange(has_written_, true)) fs::remove(out_ / runner::checksums_name);
    }

    [[nodiscard]] bool has_reference() const
    {
        const auto& axes = experiment_.whole.axes;
        return !axes.empty() && axes.front().reference.has_value();
    }

    /// True if the results include the order of the algorithms with each hand.
    [[nodiscard]] bool ranks_hands() const
    {
        const auto& axes = experiment_.whole.axes;
        const bool is_of_hands = axes.size() == 1 && axes.front().key == "hands" &&
                                 std::holds_alternative<experiment::Table1>(experiment_.whole.kind);
        return is_of_hands && std::ranges::any_of(experiment_.parts, [](const auto& part) {
                   return part.experiment.hands.people != nullptr;
               });
    }

    void add(const LoadedExperiment::Part& part, results::Table table)
    {
        const auto& axes = experiment_.whole.axes;
        if (!axes.empty()) {
            if (table.name.starts_with("replay")) return; // not kept for each point
            table = with_leading(leading_cells(axes, part), std::move(table));
            table.name += axes.size() == 1 ? "_by_axis" : "_by_point";
        }
        tables_.add(table);
        // Tables that can be read at a glance are printed on standard output, too.
        constexpr std::array<std::string_view, 4> are_short{"table1", "limits", "limits_by_axis",
                                                            "requirements"};
        if (std::ranges::find(are_short, table.name) == are_short.end()) return;
        if (table.name == "requirements") short_.clear(); // repeats the limits in fewer rows
        const auto known = std::ranges::find(short_, table.name, &results::Table::name);
        append(known == short_.end() ? short_.emplace_back(results::Table{table.name, {}}) : *known,
               table);
    }

    const LoadedExperiment& experiment_;
    const RunPlace& place_;
    fs::path out_;
    runner::ResultTables tables_;
    std::vector<std::string> names_;
    std::vector<results::Table> short_;
    std::string shown_;                           // text for standard output
    std::vector<results::AxisFindings> findings_; // for an axis with a reference, or of hands
    bool has_written_ = false;
    base::TimePoint start_;
    double start_s_;
};

/// Refuses a folder whose manifest was written by another program: it has neither sessions nor a
/// plan beside it.
base::Result<void> refuse_foreign(const fs::path& out)
{
    const bool is_ours = fs::exists(out / "sessions.jsonl") || fs::exists(out / "plan.json");
    if (is_ours || !fs::exists(out / "manifest.json")) return {};
    return base::fail(fmt::format("--out: {} holds the results of something else: choose another "
                                  "folder, or remove it",
                                  out.string()));
}

std::string stem_of(const experiment::Shard& shard)
{
    return fmt::format("{}-of-{}", shard.index, shard.count);
}

/// Adds the session files in a folder and in its shards/.
void collect_sessions(const fs::path& folder, std::vector<std::string>& paths)
{
    if (fs::exists(folder / "sessions.jsonl"))
        paths.push_back((folder / "sessions.jsonl").string());
    if (!fs::is_directory(folder / "shards")) return;
    for (const auto& entry : fs::directory_iterator{folder / "shards"}) {
        if (entry.path().extension() == ".jsonl") paths.push_back(entry.path().string());
    }
}

/// Returns the shards that have begun but not finished: "3/16, 7/16".
std::string unfinished_among(const std::vector<std::string>& files)
{
    std::vector<std::string> shards;
    for (const fs::path file : files) {
        auto done = file;
        if (file.filename() == "sessions.jsonl" || fs::exists(done.replace_extension(".done")))
            continue;
        auto name = file.stem().string();
        if (const auto of = name.find("-of-"); of != std::string::npos) name.replace(of, 4, "/");
        shards.push_back(name);
    }
    std::ranges::sort(shards);
    return fmt::format("{}", fmt::join(shards, ", "));
}

/// Returns the reason why sessions of these files are missing, or what to do about it.
std::string why_missing(const runner::SessionStore& store, const std::vector<std::string>& files)
{
    if (const auto unfinished = unfinished_among(files); !unfinished.empty())
        return "these shards have not ended: " + unfinished;
    if (store.damage()) return "run the shards with damaged lines again: they play what is missing";
    return "not all shards have begun";
}

} // namespace

base::Result<int> run_whole(const LoadedExperiment& experiment, const RunPlace& place)
{
    const fs::path out{place.out};
    auto foreign = refuse_foreign(out);
    if (!foreign) return tl::unexpected{std::move(foreign).error()};
    create_folder(place.out);
    const auto path = (out / "sessions.jsonl").string();
    const auto store =
        runner::SessionStore::open(path, identity_of(experiment), experiment.program);
    if (!store) return base::fail("--out: " + store.error().message);
    tell_of_damage(**store);
    ResultFolder folder{experiment, place};
    ShardRun run{experiment, {}, {**store, runner::play_in_virtual_time, place.threads, {}}};
    const auto done =
        run.run([&](const auto& part, const auto& found) { folder.add(part, found); });
    const auto counts = (*store)->counts();
    if (!done) throw std::runtime_error{done.error().message};
    if (!*done) {
        folder.write_manifest(counts, {"stopped before its end"});
        net::say(program_name,
                 fmt::format("stopped; {} sessions are kept in {}: the same command goes on from "
                             "there",
                             counts.played + counts.reused, place.out));
        return net::exit_failed;
    }
    const auto digest = folder.finish(counts);
    net::print(fmt::format("{}: {} sessions played, {} reused; results in {}\ndigest {}\n",
                           experiment.whole.title, counts.played, counts.reused, place.out,
                           digest));
    return 0;
}

base::Result<int> run_shard(const LoadedExperiment& experiment, const experiment::Shard& shard,
                            const RunPlace& place)
{
    const auto folder = fs::path{place.out} / "shards";
    create_folder(folder.string());
    const auto path = folder / (stem_of(shard) + ".jsonl");
    const auto store =
        runner::SessionStore::open(path.string(), identity_of(experiment), experiment.program);
    if (!store) return base::fail(store.error().message);
    tell_of_damage(**store);
    ShardRun run{experiment, shard, {**store, runner::play_in_virtual_time, place.threads, {}}};
    const auto done = run.run([](const auto&, const auto&) {});
    if (!done) throw std::runtime_error{done.error().message};
    const auto counts = (*store)->counts();
    if (!*done) {
        net::say(program_name, fmt::format("stopped; {} sessions are kept in {}: the same command "
                                           "goes on from there",
                                           counts.played + counts.reused, path.string()));
        return net::exit_failed;
    }
    write_text(folder / (stem_of(shard) + ".done"), fmt::format("{} jobs\n", run.jobs()));
    fmt::print("shard {}/{}: {} of {} jobs; {} sessions played, {} reused\n", shard.index,
               shard.count, run.jobs(), experiment.jobs, counts.played, counts.reused);
    return 0;
}

base::Result<int> merge_shards(const LoadedExperiment& experiment,
                               const std::vector<std::string>& folders, const RunPlace& place)
{
    std::vector<std::string> files;
    for (const std::string& folder : folders) collect_sessions(folder, files);
    const auto store =
        runner::SessionStore::open_all(files, identity_of(experiment), experiment.program);
    if (!store) return base::fail(store.error().message);
    tell_of_damage(**store);
    ResultFolder folder{experiment, place};
    const auto play = [](const experiment::SessionSpec& spec,
                         const auto&) -> base::Result<experiment::PlayedSession> {
        return base::fail(fmt::format("'{}' was not played", key_of(spec, "")));
    };
    ShardRun run{experiment, {}, {**store, play, place.threads, {}}};
    const auto done =
        run.run([&](const auto& part, const auto& found) { folder.add(part, found); });
    if (!done) {
        net::say(program_name, fmt::format("sessions are missing ({}): {}", done.error().message,
                                           why_missing(**store, files)));
        return net::exit_failed;
    }
    if (!*done) return net::exit_failed;
    const auto counts = (*store)->counts();
    const auto digest = folder.finish(counts);
    net::print(fmt::format("{}: {} sessions of {} files; results in {}\ndigest {}\n",
                           experiment.whole.title, counts.reused, files.size(), place.out, digest));
    return 0;
}

} // namespace hapnet::lab
