// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"

#include "emulator/core/profile/flows.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/setting_hints.hpp"
#include "emulator/core/profile/timeline.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <map>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

/// A setting of a profile and its position.
struct Placed {
    Setting setting;
    Place place;
};

/// Reads the tables of settings in one table: both, all, up, down, and those of single paths. In a
/// change, those of flows are among them.
class SettingsReader {
public:
    enum class In { profile, change };
    SettingsReader(TableReader& table, const PathNames& names, In in)
        : table_{table}, names_{names}, in_{in}
    {}

    [[nodiscard]] std::vector<Placed> read() &&
    {
        read_way("both", {});
        read_way("all", {});
        read_way("up", {"", Direction::up});
        read_way("down", {"", Direction::down});
        if (const Node* node = table_.find("matrix")) read_matrix(*node);
        if (const Node* node = table_.find("link")) {
            read_paths(*node, "link.\"1-2\"", [](std::string_view key) { return parse_way(key); });
        }
        if (const Node* node = table_.find("client")) {
            read_paths(*node, "client.3", [](std::string_view key) {
                return std::optional{Way{client_path(key), std::nullopt}};
            });
        }
        const Node* flows = in_ == In::change ? table_.find("flow") : nullptr;
        if (flows != nullptr) read_flow_tables({}, *flows);
        return std::move(all_);
    }

private:
    [[nodiscard]] Reading& reading() const { return table_.reading(); }

    void read_way(std::string_view key, const Way& way)
    {
        if (const Node* node = table_.find(key)) add(way, *node);
    }
    void add(const Way& way, const Node& node)
    {
        auto settings = read_direction(node, reading());
        const auto check = [&](const Patch& patch) {
            if (const auto valid = validate_patch(patch, way.path, names_); !valid) {
                reading().complain(node.place, valid.error().message);
            }
        };
        check(settings.patch);
        for (const RegimePatch& one : settings.of_regimes) check(one.own);
        all_.push_back({{way.direction, std::move(settings), way.path}, node.place});
    }
    [[nodiscard]] bool is_there(const Way& way, Place place) const
    {
        if (names_.contains(way.path)) return true;
        reading().complain(place, names_.refusal(way.path));
        return false;
    }

    /// Reads the tables of single paths, by the names that `way_of` parses.
    void read_paths(const Node& node, std::string_view example, const auto& way_of)
    {
        const auto* entries = std::get_if<Node::Table>(&node.value);
        if (entries == nullptr) {
            return reading().complain(node.place, fmt::format("expected tables: [{}]", example));
        }
        for (const auto& [key, place, value] : *entries) {
            const std::optional<Way> way = way_of(key);
            if (!way || way->path.empty()) {
                reading().complain(place, fmt::format("'{}' is not the name of a link: write "
                                                      "[{}]",
                                                      key, example));
            } else if (is_there(*way, place)) {
                read_path_table(*way, value);
            }
        }
    }

    /// Reads a table of a path. For a pair of peers it has the settings of one direction. For other
    /// paths it has the tables both, up and down, or the settings of both directions. Settings of
    /// flows are among them.
    void read_path_table(const Way& way, const Node& node)
    {
        const auto* entries = std::get_if<Node::Table>(&node.value);
        if (entries == nullptr) return add(way, node);
        Node rest{node.place, Node::Table{}};
        for (const base::Entry& entry : *entries) {
            const bool is_way = entry.key == "up" || entry.key == "down" || entry.key == "both";
            const auto part = is_way && !way.direction ? parse_way(entry.key) : std::nullopt;
            if (part) {
                add({way.path, part->direction}, entry.value);
            } else if (entry.key == "flow") {
                read_flow_tables(way, entry.value);
            } else {
                std::get<Node::Table>(rest.value).push_back(entry);
            }
        }
        if (!std::get<Node::Table>(rest.value).empty()) add(way, rest);
    }

    /// Reads the tables of flows by their names, on one path or on all paths.
    void read_flow_tables(const Way& way, const Node& node)
    {
        const auto* entries = std::get_if<Node::Table>(&node.value);
        if (entries == nullptr) {
            return reading().complain(node.place, "expected tables of flows: flow.NAME.up.delay");
        }
        for (const auto& [key, place, value] : *entries) {
            const Way of_flow{flow_path(way.path, key), way.direction};
            if (is_there(of_flow, place)) read_path_table(of_flow, value);
        }
    }

    /// Settings of directions, by the names of the sending and the receiving end.
    using SettingsOfWays = std::map<std::pair<std::string, std::string>, DirectionSettings>;

    void read_matrix(const Node& node)
    {
        const auto* entries = std::get_if<Node::Table>(&node.value);
        if (entries == nullptr) {
            return reading().complain(node.place, "expected a table: [matrix]");
        }
        TableReader table{*entries, node.place, reading()};
        const Node* list = table.require("peers", "write peers = [1, 2, 3]");
        const auto peers = list != nullptr ? peers_of(*list) : std::vector<std::string>{};
        SettingsOfWays settings;
        for (const std::string_view key : setting_keys) {
            const Node* rows = table.find(key);
            if (rows != nullptr && !peers.empty()) read_rows(key, *rows, peers, settings);
        }
        table.finish();
        for (auto& [name, of_way] : settings) {
            const auto way = way_between(name.first, name.second);
            if (!is_there(way, node.place)) continue;
            all_.push_back({{way.direction, std::move(of_way), way.path}, node.place});
        }
    }

    /// Returns the numbers of peers, or the letters of commands.
    [[nodiscard]] std::vector<std::string> peers_of(const Node& node) const
    {
        constexpr std::uint64_t highest = 999;
        constexpr std::size_t most = 8;
        std::vector<std::string> peers;
        std::size_t letters = 0;
        if (const auto* list = std::get_if<Node::List>(&node.value)) {
            for (const Node& element : *list) {
                const auto* text = std::get_if<std::string>(&element.value);
                const auto peer = base::count_of(element, highest);
                std::string name = peer && *peer > 0 ? std::to_string(*peer) : "";
                if (text != nullptr && is_command(*text)) name = *text;
                letters += text != nullptr ? 1 : 0;
                if (!name.empty() && std::ranges::find(peers, name) == peers.end()) {
                    peers.push_back(std::move(name));
                }
            }
            const bool are_alike = letters == 0 || letters == list->size();
            if (are_alike && peers.size() == list->size() && peers.size() >= 2 &&
                peers.size() <= most) {
                return peers;
            }
        }
        reading().complain(node.place, "expected the different numbers of 2 to 8 peers: [1, 2, 3], "
                                       "or the letters of commands: [\"a\", \"b\", \"c\"]");
        return {};
    }

    /// Reads a matrix. Row i, column j has the settings from peer i to peer j. The diagonal is
    /// ignored.
    void read_rows(std::string_view key, const Node& node, const std::vector<std::string>& peers,
                   SettingsOfWays& settings) const
    {
        const auto size = peers.size();
        const auto cells_of = [&](const Node& of) -> const Node::List* {
            const auto* list = std::get_if<Node::List>(&of.value);
            if (list != nullptr && list->size() == size) return list;
            reading().complain(of.place,
                               fmt::format("expected a list of {} rows, one for each peer, of {} "
                                           "values each",
                                           size, size));
            return nullptr;
        };
        const auto* rows = cells_of(node);
        for (std::size_t i = 0; rows != nullptr && i < size; ++i) {
            const auto* cells = cells_of((*rows)[i]);
            for (std::size_t j = 0; cells != nullptr && j < size; ++j) {
                if (i == j) continue;
                read_setting(key, (*cells)[j], settings[{peers[i], peers[j]}], reading());
            }
        }
    }

    TableReader& table_;
    const PathNames& names_;
    In in_;
    std::vector<Placed> all_{};
};

/// Returns the patch of a path by its own settings, over those of all paths.
PathPatch path_patch(const std::vector<Setting>& settings, const std::string& name,
                     const Path& after)
{
    std::vector<Setting> own;
    std::ranges::copy_if(settings, std::back_inserter(own),
                         [&](const Setting& setting) { return setting.path == name; });
    return {name, patch_of(own, name, Direction::up, after.up),
            patch_of(own, name, Direction::down, after.down)};
}

void read_time(const Node* node, base::Duration& target, Reading& reading)
{
    if (node == nullptr) return;
    read_value(*node, target, reading);
    if (target < base::Duration{0}) reading.complain(node->place, "a time cannot be negative");
}

struct PlacedChange {
    Change change;
    Place place;
    Place ramp_place;
    std::vector<Setting> of_regimes{}; // settings that depend on the conditions before them
};

PlacedChange read_change(const Node& node, const PathNames& names, Reading& reading)
{
    PlacedChange placed{{}, node.place, node.place};
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) {
        reading.complain(node.place, "expected a table with a time: [[at]]");
        return placed;
    }
    TableReader table{*entries, node.place, reading};
    read_time(table.require("time", "write time = \"10s\""), placed.change.time, reading);
    const Node* ramp = table.find("ramp");
    read_time(ramp, placed.change.ramp, reading);
    if (ramp != nullptr) placed.ramp_place = ramp->place;
    for (const Placed& side : SettingsReader{table, names, SettingsReader::In::change}.read()) {
        const DirectionSettings& settings = side.setting.settings;
        Patch patch = settings.patch;
        if (settings.burst_loss && !patch.loss) {
            reading.complain(side.place, "a change sets all laws of loss at once: write loss = "
                                         "[\"5%\", \"40/100\"] instead of burst_loss");
        } else if (settings.burst_loss) {
            patch.loss->insert(patch.loss->end(), settings.burst_loss->begin(),
                               settings.burst_loss->end());
            if (patch.loss->size() > loss_laws_max) {
                reading.complain(
                    side.place,
                    fmt::format("a direction can have at most {} laws of loss", loss_laws_max));
            }
        }
        if (settings.correlation_time && patch.jitter) {
            patch.jitter->correlation_time = *settings.correlation_time;
        } else if (settings.correlation_time && patch.delay) {
            patch.delay->correlation_time = *settings.correlation_time;
        } else if (settings.correlation_time) {
            reading.complain(side.place, "a change sets a jitter as a whole: write jitter or delay "
                                         "beside correlation_time");
        }
        if (patch.regimes || settings.are_together || !settings.of_regimes.empty()) {
            DirectionSettings of_regimes{.patch = {.regimes = patch.regimes},
                                         .of_regimes = settings.of_regimes,
                                         .are_together = settings.are_together};
            placed.of_regimes.push_back(
                {side.setting.direction, std::move(of_regimes), side.setting.path});
        }
        const auto direction = side.setting.direction;
        const auto add_to = [&](auto& target) {
            if (direction != Direction::down) target.up = merged(std::move(target.up), patch);
            if (direction != Direction::up) target.down = merged(std::move(target.down), patch);
        };
        if (side.setting.path.empty()) {
            add_to(placed.change);
        } else if (patch != Patch{}) {
            add_to(patch_for(placed.change.paths, side.setting.path));
        }
    }
    table.finish();
    return placed;
}

/// Converts the changes of regimes to complete lists, in the order of the changes.
void resolve_regimes(std::vector<PlacedChange>& changes, const Profile& profile, Reading& reading)
{
    std::map<std::string, Path> held; // conditions so far on the paths that are named
    for (PlacedChange& placed : changes) {
        for (const Setting& setting : placed.of_regimes) {
            const std::string& name = setting.path;
            const bool is_new = !held.contains(name);
            Path& now = held[name];
            if (is_new) now = profile_of(profile, name).path;
            auto after = with_settings(now, {&setting, 1}, name);
            if (!after) return reading.complain(placed.place, after.error().message);
            now = *std::move(after);
            const auto set = [&](auto& target) {
                if (setting.direction != Direction::down) target.up.regimes = now.up.regimes;
                if (setting.direction != Direction::up) target.down.regimes = now.down.regimes;
            };
            if (name.empty()) {
                set(placed.change);
            } else {
                set(patch_for(placed.change.paths, name));
            }
        }
    }
}

void read_timeline(const Node* node, const PathNames& names, Profile& profile, Reading& reading)
{
    if (node == nullptr) return;
    const auto* list = std::get_if<Node::List>(&node->value);
    if (list == nullptr) {
        return reading.complain(node->place, "write changes as [[at]]");
    }
    if (list->size() > changes_max) {
        return reading.complain(node->place,
                                fmt::format("a timeline can have at most {} changes", changes_max));
    }
    std::vector<PlacedChange> placed;
    for (const Node& element : *list) {
        placed.push_back(read_change(element, names, reading));
    }
    std::stable_sort(placed.begin(), placed.end(),
                     [](const auto& a, const auto& b) { return a.change.time < b.change.time; });
    if (reading.is_good()) resolve_regimes(placed, profile, reading);
    for (const PlacedChange& one : placed) profile.timeline.push_back(one.change);
    if (!reading.is_good()) return;
    if (const auto valid = validate_timelines(profile); !valid) {
        reading.complain(placed[valid.error().index].ramp_place, valid.error().message);
    }
}

void read_checks(const Node* node, Profile& profile, Reading& reading)
{
    if (node == nullptr) return;
    const auto* list = std::get_if<Node::List>(&node->value);
    if (list == nullptr) return reading.complain(node->place, "write checks as [[check]]");
    if (list->size() > checks_max) {
        return reading.complain(node->place,
                                fmt::format("a profile can have at most {} checks", checks_max));
    }
    for (const Node& element : *list) {
        const auto* entries = std::get_if<Node::Table>(&element.value);
        if (entries == nullptr) {
            reading.complain(element.place, "expected a table with a condition: [[check]]");
            continue;
        }
        TableReader table{*entries, element.place, reading};
        std::string text;
        const Node* require = table.require("require", "write require = \"up.received>=1000\"");
        if (require != nullptr) read_value(*require, text, reading);
        table.finish();
        if (!reading.is_good()) return;
        const auto condition = base::parse_condition(text);
        if (!condition) return reading.complain(require->place, condition.error().message);
        profile.checks.push_back(*condition);
    }
}

std::optional<base::Seed> read_seed(const Node* node, Reading& reading)
{
    if (node == nullptr) return std::nullopt;
    if (const auto* integer = std::get_if<std::int64_t>(&node->value); integer && *integer >= 0) {
        return base::Seed{static_cast<std::uint64_t>(*integer)};
    }
    // TOML has no larger whole numbers than 2^63 - 1; a seed may be larger.
    if (const auto* text = std::get_if<std::string>(&node->value)) {
        const auto seed = base::parse_count(*text, std::numeric_limits<std::uint64_t>::max());
        if (seed) return base::Seed{*seed};
    }
    reading.complain(node->place, "a seed must be a whole number from 0 to 2^64 - 1");
    return std::nullopt;
}

/// Returns the settings that are equal in both.
SettingTexts common(const SettingTexts& a, const SettingTexts& b)
{
    SettingTexts texts;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) texts[i] = a[i];
    }
    return texts;
}

void print(std::string& out, const SettingTexts& texts, const SettingTexts& but,
           const std::string& prefix)
{
    for (std::size_t i = 0; i < texts.size(); ++i) {
        if (!texts[i] || but[i]) continue;
        out += fmt::format("{}{} = {}\n", prefix, setting_keys[i], *texts[i]);
    }
}

void print_section(std::string& out, const std::string& name, const SettingTexts& texts,
                   const SettingTexts& but)
{
    std::string lines;
    print(lines, texts, but, "");
    if (!lines.empty()) out += fmt::format("\n[{}]\n{}", name, lines);
}

/// Returns the time as text. The remaining steps of a timeline may be at any time: 18.482486886s,
/// not 18482486886ns.
std::string time_text(base::Duration time)
{
    constexpr base::Duration second = std::chrono::seconds{1};
    constexpr base::Duration millisecond = std::chrono::milliseconds{1};
    if (time < second || time % millisecond == base::Duration{0}) return value_text(time);
    auto text = fmt::format("{}.{:09}", time / second, (time % second).count());
    text.erase(text.find_last_not_of('0') + 1);
    return base::quoted(text + "s");
}

/// A table, or the beginning of keys, with its settings.
struct Section {
    std::string name;
    SettingTexts texts;
    SettingTexts but; // settings that are elsewhere in the text
};

/// Returns the sections of both directions, beginning with that of their common settings. `prefix`
/// is the prefix of the path's names.
std::vector<Section> sections_of(const std::string& prefix, const Patch& up, const Patch& down)
{
    const SettingTexts of_up = setting_texts(up);
    const SettingTexts of_down = setting_texts(down);
    const SettingTexts both = common(of_up, of_down);
    return {{prefix + "both", both, {}},
            {prefix + "up", of_up, both},
            {prefix + "down", of_down, both}};
}

std::vector<Section> sections_of(const PathPatch& own)
{
    const auto [path, flow] = parts_of(own.path);
    const auto of_flow = flow.empty() ? "" : fmt::format(".flow.{}", flow);
    if (path.empty()) return sections_of(of_flow.substr(1) + ".", own.up, own.down);
    if (is_pair(path)) {
        const std::string_view of = path; // Clang 14 cannot capture a structured binding
        const auto name = [&](Direction way) {
            return fmt::format("link.{}{}", base::quoted(way_name(of, way)), of_flow);
        };
        return {{name(Direction::up), setting_texts(own.up), {}},
                {name(Direction::down), setting_texts(own.down), {}}};
    }
    const std::string prefix = client_path("");
    const bool is_client = path.starts_with(prefix);
    return sections_of(fmt::format("{}.{}{}.", is_client ? "client" : "link",
                                   base::quoted(is_client ? path.substr(prefix.size()) : path),
                                   of_flow),
                       own.up, own.down);
}

/// Prints a flow with the conditions that it has on all paths.
void print_flow(std::string& out, const Flow& flow, const std::vector<PathPatch>& paths)
{
    out += fmt::format("\n[[flow]]\n{}", flow_lines(flow));
    const auto own = std::ranges::find(paths, flow_path("", flow.name), &PathPatch::path);
    if (own == paths.end()) return;
    for (const auto& [name, texts, but] : sections_of("", own->up, own->down)) {
        print(out, texts, but, name + ".");
    }
}

void print_change(std::string& out, const Change& change)
{
    out += fmt::format("\n[[at]]\ntime = {}\n", time_text(change.time));
    if (change.ramp > base::Duration{0}) {
        out += fmt::format("ramp = {}\n", value_text(change.ramp));
    }
    const auto print_all = [&](const std::vector<Section>& sections) {
        for (const auto& [name, texts, but] : sections) print(out, texts, but, name + ".");
    };
    print_all(sections_of("", change.up, change.down));
    for (const PathPatch& own : change.paths) print_all(sections_of(own));
}

} // namespace

void read_timeline(TableReader& table, const PathNames& names, Profile& profile)
{
    read_timeline(table.find("at"), names, profile, table.reading());
}

void read_conditions(TableReader& table, const PathNames& names, Profile& profile)
{
    std::vector<Setting> settings;
    std::map<std::string, Place> places{{"", table.place()}};
    for (Placed& placed : SettingsReader{table, names, SettingsReader::In::profile}.read()) {
        places[placed.setting.path] = placed.place;
        settings.push_back(std::move(placed.setting));
    }
    for (const auto& [name, place] : places) {
        const auto common = common_name(name);
        const Path before = common.empty() ? Path{} : profile_of(profile, common).path;
        auto path = with_settings(before, settings, name);
        if (!path) {
            table.reading().complain(place, path.error().message);
        } else if (name.empty()) {
            profile.path = *std::move(path);
        } else {
            auto patch = path_patch(settings, name, *path);
            if (patch.up != Patch{} || patch.down != Patch{}) {
                profile.paths.push_back(std::move(patch));
            }
        }
    }
    std::ranges::sort(profile.paths, {}, &PathPatch::path);
}

base::Result<Profile> parse_profile(std::string_view text, const std::string& source,
                                    const OpenFile& open, const PathNames& names)
{
    Reading reading{source, open};
    reading.advise_on_keys(advice_on_key);
    const auto document = parse_document(text);
    if (!document) {
        reading.complain(document.error().place, document.error().message);
        return base::fail(*reading.complaint());
    }
    TableReader table{std::get<Node::Table>(document->value), document->place, reading};
    Profile profile;
    const Node* name = table.find("name");
    if (name != nullptr) read_value(*name, profile.name, reading);
    profile.seed = read_seed(table.find("seed"), reading);
    read_flows(table, profile);
    const PathNames all = with_flows(names, profile.flows);
    read_conditions(table, all, profile);
    read_timeline(table, all, profile);
    read_checks(table.find("check"), profile, reading);
    table.finish();
    if (!reading.is_good()) return base::fail(*reading.complaint());
    return profile;
}

std::string to_text(const Profile& profile)
{
    constexpr std::uint64_t largest_integer = std::numeric_limits<std::int64_t>::max();
    std::string out;
    if (!profile.name.empty()) out += fmt::format("name = {}\n", base::quoted(profile.name));
    if (profile.seed) {
        const auto seed = fmt::format("{}", profile.seed->value());
        out += fmt::format("seed = {}\n",
                           profile.seed->value() > largest_integer ? base::quoted(seed) : seed);
    }
    const auto print_all = [&](const std::vector<Section>& sections) {
        for (const auto& [section, texts, but] : sections) print_section(out, section, texts, but);
    };
    print_all(sections_of("", to_patch(profile.path.up), to_patch(profile.path.down)));
    for (const PathPatch& own : profile.paths) {
        if (!parts_of(own.path).path.empty()) print_all(sections_of(own));
    }
    for (const Flow& flow : profile.flows) print_flow(out, flow, profile.paths);
    for (const Change& change : profile.timeline) print_change(out, change);
    for (const base::Condition& check : profile.checks) {
        out += fmt::format("\n[[check]]\nrequire = {}\n", base::quoted(to_text(check)));
    }
    return out;
}

} // namespace hapnet::emulator
