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
#include <spdlog/fmt/fmt.h>
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
    // Parts that nest deeper than in any file of this program are left out, as they could exhaust
    // the stack.
    constexpr int depth_max = 16;
    auto json = Json::parse(
        file.text, [](int depth, Json::parse_event_t, const Json&) { return depth <= depth_max; },
        false);
    if (!json.is_object()) return base::fail(file.path + ":1: expected one JSON object");
    if (is_of_several(json)) return {}; // each of the folders that it names has its own manifest
    if (json.value("kind", Json{}) == "hands") return {}; // recordings, not results
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

/// The rules for the tables of one name.
struct TableRule {
    std::string_view name;
    /// Columns whose texts together must differ in all rows; empty: any rows may be equal.
    std::vector<std::string_view> keys{};
    bool is_ranked = false;   // true: sorted by algorithm, base first
    bool has_parties = false; // true: a page compares parties as it compares algorithms
};

const std::vector<TableRule>& table_rules()
{
    static const std::vector<TableRule> rules{
        {"table1", {"algorithm"}, true},
        {"tasks", {"algorithm", "task"}, true},
        {"limits", {"algorithm", "impairment", "task", "tier"}, true, true},
        {"requirements", {"algorithm", "task", "tier"}, true, true},
        {"limits_by_convention", {}, true, true},
        {"curves", {}, true, true},
        {"trajectories", {}, true},
        {"qos", {"algorithm", "task", "delay_ms", "jitter_ms", "loss_percent"}, true, true},
        {"qos_by_point", {}, false, true},
        {"real_time", {}, true}};
    return rules;
}

/// True for the sessions of Table 1, which plays P1 and all other tasks on one network. Other
/// sessions are not shown one by one.
bool are_of_table1(const Table& sessions)
{
    const Rows rows = rows_of(sessions);
    const auto is_p1 = [](const TableRow& row) { return row.text("task") == "P1"; };
    return std::ranges::any_of(rows, is_p1) && std::ranges::all_of(rows, [&](const TableRow& row) {
               return row.text("network") == rows.front().text("network");
           });
}

/// Renames a table of claims' sessions. Returns false if the table is not shown.
bool is_shown(Table& table)
{
    if (table.name != "sessions") return true;
    const bool is_of_claims = table.place_of("condition").has_value();
    if (is_of_claims) table.name = "claim_sessions";
    return is_of_claims || are_of_table1(table);
}

Outcome add_table(Table table, Results& results)
{
    if (table.name.starts_with("replay/")) {
        auto replay = replay_of(table);
        if (!replay) return tl::unexpected{replay.error()};
        results.replays.push_back(*std::move(replay));
        return {};
    }
    const auto known = std::ranges::find(results.tables, table.name, &Table::name);
    if (known == results.tables.end()) {
        results.tables.push_back(std::move(table));
    } else {
        append(*known, table);
    }
    return {};
}

Outcome add_tables(const File& file, Results& results)
{
    auto tables = read_tables(file.text, file.path);
    if (!tables) return tl::unexpected{tables.error()};
    const auto folder = folder_of(file.path);
    for (Table& table : *tables) {
        const auto path = fmt::format("{}{}{}.csv", folder, folder.empty() ? "" : "/", table.name);
        if (!is_shown(table)) continue;
        results.files.push_back({table.name, path});
        const auto added = add_table(std::move(table), results);
        if (!added) return base::fail(fmt::format("{}: {}", file.path, added.error().message));
    }
    return {};
}

/// Fails if two rows describe the same thing. The error names the rows.
Outcome require_once(std::string_view file, std::vector<std::string> names)
{
    std::ranges::sort(names);
    const auto twice = std::ranges::adjacent_find(names);
    if (twice == names.end()) return {};
    return base::fail(fmt::format("{} has '{}' twice, perhaps in two folders: report one at a time",
                                  file, *twice));
}

/// Returns the rank of an algorithm: base first, then the others by their names in the paper, then
/// algorithms that are not in the paper.
std::size_t rank(std::string_view algorithm)
{
    constexpr std::array<std::string_view, 3> known{"base", "sep", "dead-reckoning"};
    return static_cast<std::size_t>(std::ranges::find(known, algorithm) - known.begin());
}

Outcome put_in_order(Table& table, const TableRule& rule)
{
    const auto algorithm = table.place_of("algorithm");
    if (!algorithm) return base::fail(table.name + " has no column 'algorithm'");
    std::vector<std::string> names;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        if (rule.has_parties) table.rows[i][*algorithm] = algorithm_and_party(TableRow{table, i});
        std::string name;
        for (const std::string_view key : rule.keys) {
            const auto text = TableRow{table, i}.text(key);
            if (!text.empty()) name += (name.empty() ? "" : ", ") + text;
        }
        names.push_back(std::move(name));
    }
    if (rule.is_ranked) {
        std::ranges::stable_sort(table.rows, {}, [&](const std::vector<Cell>& row) {
            return rank(to_text(row[*algorithm]));
        });
    }
    return rule.keys.empty() ? Outcome{} : require_once(table.name + ".csv", std::move(names));
}

Outcome put_in_order(Results& results)
{
    for (const TableRule& rule : table_rules()) {
        const auto table = std::ranges::find(results.tables, rule.name, &Table::name);
        if (table == results.tables.end()) continue;
        if (auto fine = put_in_order(*table, rule); !fine) return fine;
    }
    std::vector<std::string> names;
    for (const Replay& replay : results.replays)
        names.push_back(replay.algorithm + "-" + replay.task);
    std::ranges::stable_sort(results.replays, {},
                             [](const Replay& replay) { return rank(replay.algorithm); });
    return require_once("replay/", std::move(names));
}

constexpr std::uint32_t replay_rows_per_s = 100;

/// Returns the text of a record's configuration under a key; empty when it has none.
std::string text_in(const nlohmann::json& config, const char* key)
{
    const auto found = config.find(key);
    return found != config.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Sorts the records by the peers' ids. The lower id is A.
std::vector<RecordFile> by_peer(std::span<const RecordFile> files)
{
    std::vector<RecordFile> sorted{files.begin(), files.end()};
    std::ranges::stable_sort(sorted, {}, [](const RecordFile& file) {
        const auto id = file.record->config.value("peer_id", nlohmann::json{});
        return id.is_number_integer() ? id.get<std::int64_t>() : 0;
    });
    return sorted;
}

std::string name_of(std::span<const RecordFile> records, std::size_t place)
{
    const std::string& path = records[place].path;
    return path.empty() ? fmt::format("record {}", place + 1) : path;
}

base::Result<RecordedSession> recorded_session(const std::string& name, const RecordFile& a,
                                               const RecordFile& b)
{
    const auto analysis = records::analyse(*a.record, *b.record);
    if (!analysis) return tl::unexpected{analysis.error()};
    const auto session = records::common_session(*a.record, *b.record);
    if (!session) return tl::unexpected{session.error()};
    const std::string of_task = session->task.empty() ? "session" : session->task;
    return RecordedSession{.name = name.empty() ? of_task : name,
                           .task = session->task,
                           .algorithm = text_in(a.record->config, "algorithm"),
                           .a = {session->a.peer_id, a.record->config, a.path},
                           .b = {session->b.peer_id, b.record->config, b.path},
                           .length = session->a.terms.length,
                           .analysis = *analysis,
                           .curves = curves_of(*session)};
}

/// Returns a replay without algorithm and task. nullopt: the peers were hardly ever in session at
/// the same time.
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
    std::vector<std::string> names{"A", "B"};
    if (ids.size() > 2) {
        names.clear();
        for (const std::int64_t id : ids) names.push_back(fmt::format("peer {}", id));
    }
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

const Table& Results::table(std::string_view name) const
{
    static const Table none;
    const auto found = std::ranges::find(tables, name, &Table::name);
    return found == tables.end() ? none : *found;
}

std::vector<std::string> Results::files_of(std::string_view name) const
{
    std::vector<std::string> found;
    for (const TableFile& file : files)
        if (file.table == name) found.push_back(file.path);
    return found;
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
    return add_session(results, name, std::array{RecordFile{&a}, RecordFile{&b}});
}

base::Result<void> add_session(Results& results, const std::string& name,
                               std::span<const RecordFile> records)
{
    const std::vector<RecordFile> ordered = by_peer(records);
    std::vector<RecordedSession> pairs;
    std::vector<records::Session> with_first; // the first record with each of the others
    for (std::size_t a = 0; a < ordered.size(); ++a) {
        for (std::size_t b = a + 1; b < ordered.size(); ++b) {
            auto pair = recorded_session(name, ordered[a], ordered[b]);
            if (!pair) {
                return base::fail(fmt::format("{} with {}: {}", name_of(ordered, a),
                                              name_of(ordered, b), pair.error().message));
            }
            pairs.push_back(*std::move(pair));
            if (a > 0) continue;
            with_first.push_back(*records::common_session(*ordered[0].record, *ordered[b].record));
        }
    }
    auto replay = replay_of(with_first, text_in(ordered.front().record->config, "scene_toml"));
    if (replay) { // none if the peers were hardly in session together
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
    for (const TableRow& row : results.rows("replay_scenes")) {
        for (Replay& replay : results.replays) {
            if (fmt::format("{}-{}", replay.algorithm, replay.task) != row.text("replay")) continue;
            if (!set_scene(replay, row.text("toml")))
                return base::fail("replay_scenes: the scene of " + row.text("replay") +
                                  " cannot be read: run the experiment again");
        }
    }
    const auto ordered_well = put_in_order(results);
    if (!ordered_well) return tl::unexpected{ordered_well.error()};
    return results;
}

} // namespace hapnet::lab::results
