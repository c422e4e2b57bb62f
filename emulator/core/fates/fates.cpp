// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/fates/fates.hpp"

#include "emulator/core/flow/flow.hpp"
#include "emulator/core/path_name.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

void append_number(std::string& text, std::uint64_t number)
{
    std::array<char, 20> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    text.append(digits.data(), end);
}

void append_time(std::string& text, base::Duration time)
{
    append_number(text, static_cast<std::uint64_t>(time.count()));
}

void append_states(std::string& text, const Fate& fate)
{
    auto last = fate.states.size();
    while (last > 0 && fate.states[last - 1] == LossState::none) --last;
    for (std::size_t i = 0; i < last; ++i) {
        if (i > 0) text += '/';
        text += to_text(fate.states[i]);
    }
}

void append_delivery(std::string& text, const Fate& fate)
{
    append_time(text, fate.delay);
    text += ',';
    if (fate.copy_after) append_time(text, *fate.copy_after);
    text += ',';
    for (std::size_t i = 0; i < fate.flips.count; ++i) {
        if (i > 0) text += '|';
        append_number(text, fate.flips.places[i]);
    }
    text += ',';
    const Displacement& displacement = fate.displacement;
    if (displacement.places > 0) append_number(text, displacement.places);
    text += ',';
    if (displacement.time > base::Duration{0}) append_time(text, displacement.time);
}

} // namespace

void append_row(std::string& text, Direction direction, std::uint64_t number, const Fate& fate,
                const RegimeNames* regimes)
{
    text += to_text(direction);
    text += ',';
    append_number(text, number);
    text += fate.drop ? ",drop," : ",deliver,";
    if (fate.drop) text += to_text(*fate.drop);
    text += ',';
    append_states(text, fate);
    text += ',';
    if (regimes != nullptr) {
        if (fate.regime > 0 && fate.regime <= regimes->size()) text += (*regimes)[fate.regime - 1U];
        text += ',';
    }
    if (fate.drop) {
        text += ",,,,";
    } else {
        append_delivery(text, fate);
    }
    text += '\n';
}

std::string to_text(const Fates& fates)
{
    FatesOfPaths only;
    only.emplace("", fates);
    return to_text(only);
}

// Reading.

namespace {

enum FateColumn : std::size_t {
    direction,
    number,
    verdict,
    cause,
    states,
    delay,
    copy,
    flips,
    places,
    displaced,
    column_count,
};

using FateCells = std::array<std::string_view, column_count>;

/// Removes and returns the beginning of `text` up to the next `separator`; all of it when there is
/// none.
std::string_view take(std::string_view& text, char separator)
{
    const auto at = std::min(text.find(separator), text.size());
    const auto taken = text.substr(0, at);
    text.remove_prefix(std::min(at + 1, text.size()));
    return taken;
}

/// `regime` receives the cell of that column; null: there is no such column.
base::Result<FateCells> columns_of(std::string_view line, std::string_view* regime)
{
    const auto separators = std::count(line.begin(), line.end(), ',');
    const int count = column_count + (regime != nullptr ? 1 : 0);
    if (separators != count - 1) {
        return base::fail(fmt::format("expected {} columns, found {}", count, separators + 1));
    }
    FateCells columns;
    for (std::size_t i = 0; i < columns.size(); ++i) {
        columns[i] = take(line, ',');
        if (i == states && regime != nullptr) *regime = take(line, ',');
    }
    return columns;
}

/// Returns the number of the regime that a cell names: 1 for the first known one, 0 for no name.
base::Result<std::uint8_t> regime_of(std::string_view cell, RegimeNames& known)
{
    if (cell.empty()) return 0;
    const auto found = std::ranges::find(known, cell);
    if (found == known.end()) {
        if (!validate_flow_name(cell) || known.size() == regimes_max) {
            return base::fail(fmt::format("{}: expected one of at most {} names of regimes, found "
                                          "'{}'",
                                          regime_column, regimes_max, cell));
        }
        known.emplace_back(cell);
        return static_cast<std::uint8_t>(known.size());
    }
    return static_cast<std::uint8_t>(found - known.begin() + 1);
}

/// Reads a whole number without leading zeros.
std::optional<std::uint64_t> whole(std::string_view text, std::uint64_t most)
{
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_whole = error == std::errc{} && end == text.data() + text.size();
    if (!is_whole || value > most || (text.size() > 1 && text.front() == '0')) return std::nullopt;
    return value;
}

base::Result<base::Duration> time_of(std::string_view text, std::string_view column)
{
    const auto nanoseconds = whole(text, static_cast<std::uint64_t>(fate_time_max.count()));
    if (nanoseconds) return base::Duration{static_cast<base::Duration::rep>(*nanoseconds)};
    return base::fail(fmt::format("{}: expected whole nanoseconds up to {}, found '{}'", column,
                                  fate_time_max.count(), text));
}

base::Result<decltype(Fate::states)> states_of(std::string_view text)
{
    decltype(Fate::states) read{};
    if (text.empty()) return read;
    const auto given = static_cast<std::size_t>(std::count(text.begin(), text.end(), '/')) + 1;
    if (given > loss_laws_max) {
        return base::fail(
            fmt::format("states: expected at most {}, found {}", loss_laws_max, given));
    }
    for (std::size_t i = 0; i < given; ++i) {
        const auto name = take(text, '/');
        const auto state = base::named<LossState>(name);
        if (!state) return base::fail(fmt::format("states: unknown state '{}'", name));
        if (*state == LossState::none && i + 1 == given) {
            return base::fail("states: leave out 'none' at the end");
        }
        read[i] = *state;
    }
    return read;
}

base::Result<Flips> flips_of(std::string_view text)
{
    Flips read;
    if (text.empty()) return read;
    const auto given = static_cast<std::size_t>(std::count(text.begin(), text.end(), '|')) + 1;
    if (given > Flips::most) {
        return base::fail(
            fmt::format("flipped_bits: expected at most {}, found {}", Flips::most, given));
    }
    for (std::size_t i = 0; i < given; ++i) {
        const auto word = take(text, '|');
        const auto place = whole(word, std::numeric_limits<std::uint32_t>::max());
        if (!place) {
            return base::fail(fmt::format("flipped_bits: expected places, found '{}'", word));
        }
        read.places[i] = static_cast<std::uint32_t>(*place);
    }
    read.count = static_cast<std::uint8_t>(given);
    return read;
}

base::Result<Displacement> displacement_of(const FateCells& columns)
{
    Displacement read;
    if (!columns[places].empty()) {
        const auto count = whole(columns[places], std::numeric_limits<std::uint32_t>::max());
        if (!count || *count == 0) {
            return base::fail(
                fmt::format("displaced_places: expected nothing or a number from 1, found '{}'",
                            columns[places]));
        }
        read.places = static_cast<std::uint32_t>(*count);
    }
    if (!columns[displaced].empty()) {
        const auto time = time_of(columns[displaced], "displaced_ns");
        if (!time) return tl::unexpected{time.error()};
        if (*time == base::Duration{0}) {
            return base::fail("displaced_ns: expected nothing or a number from 1, found '0'");
        }
        read.time = *time;
    }
    return read;
}

base::Result<Fate> delivery_of(const FateCells& columns)
{
    Fate fate;
    if (!columns[cause].empty())
        return base::fail("cause: leave it empty, only a drop has a cause");
    const auto drawn = time_of(columns[delay], "delay_ns");
    if (!drawn) return tl::unexpected{drawn.error()};
    fate.delay = *drawn;
    if (!columns[copy].empty()) {
        const auto offset = time_of(columns[copy], "copy_after_ns");
        if (!offset) return tl::unexpected{offset.error()};
        fate.copy_after = *offset;
    }
    const auto inverted = flips_of(columns[flips]);
    if (!inverted) return tl::unexpected{inverted.error()};
    fate.flips = *inverted;
    const auto displacement = displacement_of(columns);
    if (!displacement) return tl::unexpected{displacement.error()};
    fate.displacement = *displacement;
    return fate;
}

base::Result<Fate> drop_of(const FateCells& columns)
{
    const auto why = base::named<DropCause>(columns[cause]);
    if (!why) return base::fail(fmt::format("cause: unknown cause '{}'", columns[cause]));
    for (std::size_t i = delay; i < column_count; ++i) {
        if (!columns[i].empty()) {
            return base::fail("a drop must be empty after its states");
        }
    }
    return Fate{.drop = *why};
}

base::Result<Fate> fate_of(const FateCells& columns)
{
    const bool is_drop = columns[verdict] == "drop";
    if (!is_drop && columns[verdict] != "deliver") {
        return base::fail(
            fmt::format("verdict: expected deliver or drop, found '{}'", columns[verdict]));
    }
    auto fate = is_drop ? drop_of(columns) : delivery_of(columns);
    if (!fate) return fate;
    const auto in_states = states_of(columns[states]);
    if (!in_states) return tl::unexpected{in_states.error()};
    fate->states = *in_states;
    return fate;
}

/// Appends the fate in `line` to `fates`.
base::Result<void> read_row(std::string_view line, Fates& fates, bool has_regimes)
{
    std::string_view regime;
    const auto columns = columns_of(line, has_regimes ? &regime : nullptr);
    if (!columns) return tl::unexpected{columns.error()};
    const auto way = base::named<Direction>((*columns)[direction]);
    if (!way) {
        return base::fail(
            fmt::format("direction: expected up or down, found '{}'", (*columns)[direction]));
    }
    if (way == Direction::up && !fates.down.empty()) {
        return base::fail("direction: the rows of up must come before those of down");
    }
    auto& list = way == Direction::up ? fates.up : fates.down;
    if (whole((*columns)[number], std::numeric_limits<std::uint64_t>::max()) != list.size()) {
        return base::fail(
            fmt::format("number: expected {}, found '{}'", list.size(), (*columns)[number]));
    }
    auto fate = fate_of(*columns);
    if (!fate) return tl::unexpected{fate.error()};
    const auto of = regime_of(regime, way == Direction::up ? fates.regimes_up : fates.regimes_down);
    if (!of) return tl::unexpected{of.error()};
    fate->regime = *of;
    list.push_back(*fate);
    return {};
}

/// Reads the rows of a table after its head, each by `read`.
template <typename Read>
base::Result<void> read_rows(std::string_view text, std::string_view head, const Read& read)
{
    for (std::size_t line = 1; line == 1 || !text.empty(); ++line) {
        const auto refuse = [&](std::string_view reason) {
            return base::fail(fmt::format("line {}: {}", line, reason));
        };
        if (text.find('\n') == std::string_view::npos) {
            return refuse("the end of the line is missing: was the file cut off?");
        }
        const auto row = take(text, '\n');
        if (line == 1) {
            if (row != head) return refuse(fmt::format("expected '{}'", head));
        } else if (const auto done = read(row); !done) {
            return refuse(done.error().message);
        }
    }
    return {};
}

/// Adds the fate in `row` to those of its path. `path` and `last` are those of the previous row.
base::Result<void> read_row_of_path(std::string_view row, FateColumns columns, FatesOfPaths& fates,
                                    Fates*& last, std::string& path)
{
    const auto of = columns.has_paths ? take(row, ',') : std::string_view{};
    const auto flow = columns.has_flows ? take(row, ',') : rest_of_flows;
    const auto name = flow_path(of, flow == rest_of_flows ? "" : flow);
    if (last == nullptr || name != path) {
        const auto way = parse_way(of);
        if (columns.has_paths && (!way || way->path != of || of.empty())) {
            return base::fail(fmt::format("{}: expected the name of a link, such as 1-2, found "
                                          "'{}'",
                                          path_column, of));
        }
        if (flow != rest_of_flows && !validate_flow_name(flow)) {
            return base::fail(fmt::format("{}: expected the name of a flow or {}, found '{}'",
                                          flow_column, rest_of_flows, flow));
        }
        const auto [place, is_new] = fates.try_emplace(name);
        if (!is_new) {
            return base::fail(
                fmt::format("{}: the rows of {} must follow each other", path_column, name));
        }
        last = &place->second;
        path = name;
    }
    return read_row(row, *last, columns.has_regimes);
}

} // namespace

base::Result<Fates> parse_fates(std::string_view text)
{
    Fates fates;
    return read_rows(text, fates_header,
                     [&](std::string_view row) { return read_row(row, fates, false); })
        .map([&] { return std::move(fates); });
}

base::Result<Fates> with_regimes(Fates fates, const RegimeNames& up, const RegimeNames& down)
{
    const auto recount = [](std::vector<Fate>& list, const RegimeNames& from,
                            const RegimeNames& to) -> base::Result<void> {
        std::vector<std::uint8_t> counts{0};
        for (const std::string& name : from) {
            const auto found = std::ranges::find(to, name);
            if (found == to.end()) {
                return base::fail(fmt::format("these fates are of a run with the regime '{}', "
                                              "which the profile does not have",
                                              name));
            }
            counts.push_back(static_cast<std::uint8_t>(found - to.begin() + 1));
        }
        for (Fate& fate : list) fate.regime = counts[fate.regime];
        return {};
    };
    for (const auto& done :
         {recount(fates.up, fates.regimes_up, up), recount(fates.down, fates.regimes_down, down)}) {
        if (!done) return tl::unexpected{done.error()};
    }
    fates.regimes_up = up;
    fates.regimes_down = down;
    return fates;
}

std::string head_of_fates(FateColumns columns)
{
    constexpr std::string_view last_before_regime = "states,";
    std::string head{fates_header};
    if (columns.has_regimes) {
        head.insert(head.find(last_before_regime) + last_before_regime.size(),
                    fmt::format("{},", regime_column));
    }
    return fmt::format("{}{}{}{}{}", columns.has_paths ? path_column : "",
                       columns.has_paths ? "," : "", columns.has_flows ? flow_column : "",
                       columns.has_flows ? "," : "", head);
}

std::string row_begin(FateColumns columns, std::string_view path)
{
    const auto [of, flow] = parts_of(path);
    std::string begin;
    if (columns.has_paths) begin += fmt::format("{},", of);
    if (columns.has_flows) begin += fmt::format("{},", flow.empty() ? rest_of_flows : flow);
    return begin;
}

std::string to_text(const FatesOfPaths& fates)
{
    FateColumns columns;
    for (const auto& [path, own] : fates) {
        columns.has_paths = columns.has_paths || !parts_of(path).path.empty();
        columns.has_flows = columns.has_flows || !parts_of(path).flow.empty();
        columns.has_regimes =
            columns.has_regimes || !own.regimes_up.empty() || !own.regimes_down.empty();
    }
    std::string text = head_of_fates(columns) + "\n";
    for (const auto& [path, own] : fates) {
        const auto begin = row_begin(columns, path);
        for (const Direction direction : {Direction::up, Direction::down}) {
            const bool is_up = direction == Direction::up;
            const RegimeNames& regimes = is_up ? own.regimes_up : own.regimes_down;
            std::uint64_t number = 0;
            for (const Fate& fate : is_up ? own.up : own.down) {
                text += begin;
                append_row(text, direction, number++, fate,
                           columns.has_regimes ? &regimes : nullptr);
            }
        }
    }
    return text;
}

base::Result<FatesOfPaths> parse_fates_of_paths(std::string_view text)
{
    const auto head = text.substr(0, text.find('\n'));
    const auto has = [&](std::string_view column) {
        return head.find(column) != std::string_view::npos;
    };
    const FateColumns columns{.has_paths = text.starts_with(path_column),
                              .has_flows = has(",flow,") || text.starts_with(flow_column),
                              .has_regimes = has(",regime,")};
    if (columns == FateColumns{}) {
        return parse_fates(text).map([](Fates only) {
            FatesOfPaths all;
            all.emplace("", std::move(only));
            return all;
        });
    }
    FatesOfPaths fates;
    Fates* last = nullptr;
    std::string path;
    return read_rows(text, head_of_fates(columns),
                     [&](std::string_view row) {
                         return read_row_of_path(row, columns, fates, last, path);
                     })
        .map([&] { return std::move(fates); });
}

} // namespace hapnet::emulator
