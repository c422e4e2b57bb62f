// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/results.hpp"

#include "lab/records/recorded_trace.hpp"
#include "lab/results/party_columns.hpp"
#include "lab/results/several.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <map>
#include <spdlog/fmt/fmt.h>
#include <type_traits>
#include <utility>

namespace hapnet::lab::results {

namespace {

using Json = nlohmann::ordered_json;
using Outcome = base::Result<void>;

std::string_view file_name_of(std::string_view path) { return path.substr(path.rfind('/') + 1); }

std::string folder_of(std::string_view path)
{
    const auto slash = path.rfind('/');
    return std::string{path.substr(0, slash == std::string_view::npos ? 0 : slash)};
}

Outcome add_run(const File& file, Results& results)
{
    // What nests deeper than anything that we write is left out: it could exhaust the stack.
    constexpr int depth_max = 16;
    auto json = Json::parse(
        file.text, [](int depth, Json::parse_event_t, const Json&) { return depth <= depth_max; },
        false);
    if (!json.is_object()) return base::fail(file.path + ":1: expected one JSON object");
    if (is_of_several(json)) return {}; // the folders that it names have their own
    Run run{folder_of(file.path), std::move(json), std::nullopt};
    const auto criteria = run.manifest.find("criteria");
    if (criteria != run.manifest.end() && criteria->is_string()) {
        auto parsed =
            metrics::parse_criteria(criteria->get<std::string>(), file.path + ": criteria");
        if (!parsed) return tl::unexpected{parsed.error()};
        run.criteria = *parsed;
    }
    results.runs.push_back(std::move(run));
    return {};
}

template <typename Value>
Outcome append(std::vector<Value>& all, base::Result<std::vector<Value>> rows)
{
    if (!rows) return tl::unexpected{rows.error()};
    all.insert(all.end(), std::make_move_iterator(rows->begin()),
               std::make_move_iterator(rows->end()));
    return {};
}

Outcome add_replay(const File& file, Results& results)
{
    auto replay = read_replay(file);
    if (!replay) return tl::unexpected{replay.error()};
    results.replays.push_back(*std::move(replay));
    return {};
}

struct FileKind {
    std::string_view name;
    Outcome (*add)(const File&, Results&);
};

/// A file whose rows are kept as they are read.
template <auto rows>
Outcome add_rows(const File& file, Results& results)
{
    using Row = typename std::remove_reference_t<decltype(results.*rows)>::value_type;
    auto read = base::read_csv<Row>(file.text, file.path);
    if constexpr (requires(Row row) { row.peers; }) {
        // A page compares parties as it compares algorithms.
        for (std::size_t i = 0; read && i < read->size(); ++i)
            (*read)[i].algorithm = algorithm_and_party((*read)[i]);
    }
    return append(results.*rows, std::move(read));
}

/// Those of Table 1, which plays P1 and all else on one network, and those of claims, which have
/// columns of their own; others are not shown one by one.
Outcome add_sessions(const File& file, Results& results)
{
    const std::string_view header = std::string_view{file.text}.substr(0, file.text.find('\n'));
    if (header.find("condition") != std::string_view::npos) {
        return append(results.claim_sessions,
                      base::read_csv<ClaimSessionRow>(file.text, file.path));
    }
    if (header.find("network") == std::string_view::npos) return {};
    auto rows = base::read_csv<SessionRow>(file.text, file.path);
    if (!rows) return tl::unexpected{rows.error()};
    const auto is_other = [&](const SessionRow& row) {
        return row.network != rows->front().network;
    };
    const bool has_p1 = std::ranges::find(*rows, "P1", &SessionRow::task) != rows->end();
    if (!has_p1 || std::ranges::any_of(*rows, is_other)) return {};
    return append(results.rows_of_sessions, std::move(rows));
}

Outcome add_points(const File& file, Results& results)
{
    auto rows = base::read_csv<PointQosRow>(file.text, file.path);
    if (rows)
        for (PointQosRow& row : *rows) row.cell.algorithm = algorithm_and_party(row.cell);
    return append(results.qos_by_point, std::move(rows));
}

constexpr std::array kinds{FileKind{"manifest.json", add_run},
                           FileKind{"sessions.csv", add_sessions},
                           FileKind{"paired.csv", add_rows<&Results::paired>},
                           FileKind{"precision.csv", add_rows<&Results::precision>},
                           FileKind{"limits_by_axis.csv", add_rows<&Results::limits_by_axis>},
                           FileKind{"table1.csv", add_rows<&Results::table1>},
                           FileKind{"tasks.csv", add_rows<&Results::tasks>},
                           FileKind{"limits.csv", add_rows<&Results::limits>},
                           FileKind{"limits_by_convention.csv", add_rows<&Results::sensitivity>},
                           FileKind{"curves.csv", add_rows<&Results::curves>},
                           FileKind{"trajectories.csv",
                                    [](const File& f, Results& r) {
                                        return append(r.trajectories, read_trajectories(f));
                                    }},
                           FileKind{"qos.csv", add_rows<&Results::qos>},
                           FileKind{"qos_by_point.csv", add_points},
                           FileKind{"claims.csv", add_rows<&Results::claims>},
                           FileKind{"claims_quantiles.csv", add_rows<&Results::claims_quantiles>},
                           FileKind{"real_time.csv", add_rows<&Results::real_time>}};

constexpr FileKind replay_kind{"*.csv", add_replay};

const FileKind* kind_of(std::string_view path)
{
    const auto folder = folder_of(path);
    if (file_name_of(folder) == "replay" && path.ends_with(".csv")) return &replay_kind;
    const auto found = std::find_if(kinds.begin(), kinds.end(), [&](const FileKind& kind) {
        return kind.name == file_name_of(path);
    });
    return found == kinds.end() ? nullptr : &*found;
}

/// Says which rows give one thing twice.
template <typename Value, typename Name>
Outcome require_once(const std::vector<Value>& rows, std::string_view file, const Name& name)
{
    std::map<std::string, int> counts;
    for (const Value& row : rows) {
        const std::string one = name(row);
        if (++counts[one] == 1) continue;
        return base::fail(fmt::format("{} has '{}' twice, perhaps in two folders: report one at a "
                                      "time",
                                      file, one));
    }
    return {};
}

Outcome require_each_once(const Results& results)
{
    return require_once(results.table1, "table1.csv",
                        [](const Table1Row& row) { return row.algorithm; })
        .and_then([&] {
            return require_once(results.tasks, "tasks.csv", [](const TaskRow& row) {
                return row.algorithm + " in " + row.task;
            });
        })
        .and_then([&] {
            return require_once(results.limits, "limits.csv", [](const LimitRow& row) {
                return row.algorithm + ", " + row.impairment + ", " + row.task;
            });
        })
        .and_then([&] {
            return require_once(results.qos, "qos.csv", [](const QosRow& row) {
                return fmt::format("{}, {}, {} ms, {} ms, {} %", row.algorithm, row.task,
                                   row.delay_ms, row.jitter_ms, row.loss_percent);
            });
        })
        .and_then([&] {
            return require_once(results.replays, "replay/", [](const Replay& replay) {
                return replay.algorithm + "-" + replay.task;
            });
        });
}

/// Base first, then the others as the paper names them, then what it does not know.
std::size_t rank(std::string_view algorithm)
{
    constexpr std::array<std::string_view, 3> known{"base", "sep", "dead-reckoning"};
    return static_cast<std::size_t>(std::find(known.begin(), known.end(), algorithm) -
                                    known.begin());
}

template <typename Value>
void put_in_order(std::vector<Value>& rows)
{
    std::stable_sort(rows.begin(), rows.end(), [](const Value& a, const Value& b) {
        return rank(a.algorithm) < rank(b.algorithm);
    });
}

constexpr std::uint32_t replay_rows_per_s = 100;

/// What a record's configuration says under a key; empty when it says nothing.
std::string text_in(const nlohmann::json& config, const char* key)
{
    const auto found = config.find(key);
    return found != config.end() && found->is_string() ? found->get<std::string>() : "";
}

base::Result<RecordedSession> recorded_session(const std::string& name, const record::Record& a,
                                               const record::Record& b)
{
    const auto analysis = records::analyse(a, b);
    if (!analysis) return tl::unexpected{analysis.error()};
    const auto session = records::common_session(a, b);
    if (!session) return tl::unexpected{session.error()};
    const std::string of_task = session->task.empty() ? "session" : session->task;
    return RecordedSession{.name = name.empty() ? of_task : name,
                           .task = session->task,
                           .algorithm = text_in(a.config, "algorithm"),
                           .peer_a = session->a.peer_id,
                           .peer_b = session->b.peer_id,
                           .analysis = *analysis,
                           .curves = curves_of(*session)};
}

/// Without algorithm and task. nullopt: they were hardly ever in session at the same time.
std::optional<Replay> replay_of(std::span<const records::Session> sessions,
                                const std::string& scene_toml)
{
    constexpr base::Duration step = base::Duration{std::chrono::seconds{1}} / replay_rows_per_s;
    const virtual_time::Trace trace = trace_of(sessions);
    const auto every = static_cast<std::size_t>(std::max<std::int64_t>(step / trace.tick, 1));
    if (trace.sides.front().size() < every + 1) return std::nullopt;
    Replay replay{.algorithm = "", .task = "", .start_s = base::to_seconds(trace.begin)};
    replay.step_s = base::to_seconds(static_cast<std::int64_t>(every) * trace.tick);
    if (const auto scene = scene::parse_scene(scene_toml, "scene_toml")) replay.scene = *scene;
    std::vector<std::int64_t> ids{sessions.front().a.peer_id};
    for (const records::Session& session : sessions) ids.push_back(session.b.peer_id);
    std::ranges::sort(ids);
    std::vector<std::string> names;
    for (const std::int64_t id : ids) names.push_back(fmt::format("peer {}", id));
    replay.sides = replay_sides(trace, names, every);
    for (const records::RecordedBody& body : bodies_of(sessions)) {
        const auto first = first_movable(replay.scene);
        replay.shared.push_back(body.number ? std::size_t{*body.number} : first);
    }
    return replay;
}

} // namespace

bool Run::is_valid() const
{
    const auto found = manifest.find("valid");
    return found != manifest.end() && found->is_boolean() && found->get<bool>();
}

std::optional<metrics::Criteria> Results::criteria() const
{
    if (runs.empty()) return std::nullopt;
    const auto first = runs.front().criteria;
    const bool is_one = std::all_of(runs.begin(), runs.end(),
                                    [&](const Run& run) { return run.criteria == first; });
    return is_one ? first : std::nullopt;
}

base::Result<void> add_session(Results& results, const std::string& name, const record::Record& a,
                               const record::Record& b)
{
    const std::array records{&a, &b};
    return add_session(results, name, records);
}

base::Result<void> add_session(Results& results, const std::string& name,
                               std::span<const record::Record* const> records)
{
    std::vector<RecordedSession> pairs;
    std::vector<records::Session> with_first; // of the first record with each of the others
    for (std::size_t a = 0; a < records.size(); ++a) {
        for (std::size_t b = a + 1; b < records.size(); ++b) {
            auto pair = recorded_session(name, *records[a], *records[b]);
            if (!pair) {
                return base::fail(fmt::format("record {} with record {}: {}", a + 1, b + 1,
                                              pair.error().message));
            }
            pairs.push_back(*std::move(pair));
            if (a == 0) with_first.push_back(*records::common_session(*records[0], *records[b]));
        }
    }
    auto replay = replay_of(with_first, text_in(records.front()->config, "scene_toml"));
    if (replay) { // there is none when they were hardly in session together
        const std::string& algorithm = pairs.front().algorithm;
        replay->algorithm = algorithm.empty() ? "recorded" : algorithm;
        replay->task = pairs.front().name;
        results.replays.push_back(*std::move(replay));
    }
    std::ranges::move(pairs, std::back_inserter(results.sessions));
    return {};
}

bool is_result_file(std::string_view path) { return kind_of(path) != nullptr; }

base::Result<Results> read_results(std::span<const File> files)
{
    std::vector<const File*> ordered;
    for (const File& file : files) ordered.push_back(&file);
    std::sort(ordered.begin(), ordered.end(),
              [](const File* a, const File* b) { return a->path < b->path; });
    Results results;
    for (const File* file : ordered) {
        const FileKind* kind = kind_of(file->path);
        if (kind == nullptr) continue;
        const auto added = kind->add(*file, results);
        if (!added) return tl::unexpected{added.error()};
    }
    const auto once = require_each_once(results);
    if (!once) return tl::unexpected{once.error()};
    put_in_order(results.table1);
    put_in_order(results.tasks);
    put_in_order(results.limits);
    put_in_order(results.sensitivity);
    put_in_order(results.curves);
    put_in_order(results.trajectories);
    put_in_order(results.qos);
    put_in_order(results.real_time);
    put_in_order(results.replays);
    return results;
}

} // namespace hapnet::lab::results
