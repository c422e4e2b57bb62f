// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/results.hpp"

#include "lab/records/recorded_trace.hpp"
#include "lab/results/party_columns.hpp"
#include "lab/results/several.hpp"
#include "lab/results/table_text.hpp"
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

/// A leaf of a cell; nullopt: it is empty.
std::optional<base::Leaf> leaf_of(const Cell& cell)
{
    return std::visit(
        [](const auto& value) -> std::optional<base::Leaf> {
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>) {
                return std::nullopt;
            } else {
                return base::Leaf{value};
            }
        },
        cell);
}

/// False: the field is of another type, or has to have a value.
bool set_field(const base::FieldRow& field, const Cell& cell, void* owner)
{
    const auto leaf = leaf_of(cell);
    void* value = field.in(owner);
    if (field.kind->shape != base::ValueKind::Shape::maybe)
        return field.kind->set(value, leaf.value_or(base::Leaf{std::string{}}));
    if (!leaf) return true;
    return field.kind->element->set(field.kind->add(value), *leaf);
}

/// The rows of a table as structs whose fields are described.
template <typename Value>
Outcome append(std::vector<Value>& all, const Table& table)
{
    for (const TableRow& row : rows_of(table)) {
        Value& value = all.emplace_back();
        for (const base::FieldRow& field : base::field_table<Value>().rows) {
            if (field.is_spare && !table.place_of(field.key)) continue;
            if (set_field(field, row[field.key], &value)) continue;
            return base::fail(
                fmt::format("{}: {}: found '{}'", table.name, field.key, row.text(field.key)));
        }
        if constexpr (requires {
                          value.peers;
                          value.scene->size();
                      })
            value.algorithm = algorithm_and_party(value); // a page compares parties as algorithms
    }
    return {};
}

template <auto rows>
Outcome add_rows(const Table& table, Results& results)
{
    return append(results.*rows, table);
}

/// Those of Table 1, which plays P1 and all else on one network, and those of claims, which have
/// columns of their own; others are not shown one by one.
Outcome add_sessions(const Table& table, Results& results)
{
    if (table.place_of("condition")) return append(results.claim_sessions, table);
    std::vector<SessionRow> rows;
    if (auto fine = append(rows, table); !fine) return fine;
    const auto is_other = [&](const SessionRow& row) {
        return row.network != rows.front().network;
    };
    const bool has_p1 = std::ranges::find(rows, "P1", &SessionRow::task) != rows.end();
    if (has_p1 && !std::ranges::any_of(rows, is_other))
        std::ranges::move(rows, std::back_inserter(results.rows_of_sessions));
    return {};
}

Outcome add_points(const Table& table, Results& results)
{
    const auto before = results.qos_by_point.size();
    auto fine = append(results.qos_by_point, table);
    for (std::size_t i = before; i < results.qos_by_point.size(); ++i) {
        QosRow& cell = results.qos_by_point[i].cell;
        cell.algorithm = algorithm_and_party(cell);
    }
    return fine;
}

Outcome add_replay(const Table& table, Results& results)
{
    std::vector<ReplayRow> rows;
    if (auto fine = append(rows, table); !fine) return fine;
    auto replay = replay_of(table.name, rows);
    if (!replay) return tl::unexpected{replay.error()};
    results.replays.push_back(*std::move(replay));
    return {};
}

Outcome add_trajectories(const Table& table, Results& results)
{
    if (auto fine = append(results.trajectories, table); !fine) return fine;
    return require_increasing(results.trajectories);
}

struct TableKind {
    std::string_view name;
    Outcome (*add)(const Table&, Results&);
};

constexpr std::array kinds{TableKind{"sessions", add_sessions},
                           TableKind{"paired", add_rows<&Results::paired>},
                           TableKind{"precision", add_rows<&Results::precision>},
                           TableKind{"limits_by_axis", add_rows<&Results::limits_by_axis>},
                           TableKind{"table1", add_rows<&Results::table1>},
                           TableKind{"tasks", add_rows<&Results::tasks>},
                           TableKind{"limits", add_rows<&Results::limits>},
                           TableKind{"limits_by_convention", add_rows<&Results::sensitivity>},
                           TableKind{"curves", add_rows<&Results::curves>},
                           TableKind{"trajectories", add_trajectories},
                           TableKind{"qos", add_rows<&Results::qos>},
                           TableKind{"qos_by_point", add_points},
                           TableKind{"claims", add_rows<&Results::claims>},
                           TableKind{"claims_quantiles", add_rows<&Results::claims_quantiles>},
                           TableKind{"real_time", add_rows<&Results::real_time>}};

Outcome add_tables(const File& file, Results& results)
{
    const auto tables = read_tables(file.text, file.path);
    if (!tables) return tl::unexpected{tables.error()};
    for (const Table& table : *tables) {
        const auto kind = std::ranges::find(kinds, table.name, &TableKind::name);
        Outcome fine;
        if (table.name.starts_with("replay/")) {
            fine = add_replay(table, results);
        } else if (kind != kinds.end()) {
            fine = kind->add(table, results);
        }
        if (!fine) return base::fail(fmt::format("{}: {}", file.path, fine.error().message));
        const auto folder = folder_of(file.path);
        results.files.push_back(
            fmt::format("{}{}{}.csv", folder, folder.empty() ? "" : "/", table.name));
    }
    return {};
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

base::Result<Results> read_results(std::span<const File> files)
{
    std::vector<const File*> ordered;
    for (const File& file : files) ordered.push_back(&file);
    std::sort(ordered.begin(), ordered.end(),
              [](const File* a, const File* b) { return a->path < b->path; });
    Results results;
    for (const File* file : ordered) {
        const bool is_manifest = file_name_of(file->path) == "manifest.json";
        const auto added = is_manifest ? add_run(*file, results) : add_tables(*file, results);
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
