// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/recording.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::lab::hands {

namespace {

constexpr std::array<std::string_view, 7> meanings{"time", "x", "y", "z", "b.x", "b.y", "b.z"};
constexpr std::array<base::ColumnUnit, 3> length_units{{{"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}}};
constexpr std::array<base::ColumnUnit, 4> time_units{
    {{"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
constexpr double farthest_m = 1000.0;
constexpr double latest_s = 1e11; // a clock that counts from an epoch has about 2e9

/// Returns the kinds of columns that a table may hold: the positions of the first and the second
/// person, and the time.
std::array<base::ColumnKind, 7> kinds_of(const RecordingFormat& format)
{
    constexpr std::array<std::string_view, 3> usual{"x_m or x_mm, or x with --units",
                                                    "y_m or y_mm, or y with --units",
                                                    "z_m or z_mm, or z with --units"};
    std::array<base::ColumnKind, 7> kinds;
    for (std::size_t i = 0; i < 6; ++i) {
        kinds[i] = {.what = meanings[i + 1],
                    .units = length_units,
                    .bare_factor = format.m_per_unit,
                    .most = farthest_m,
                    .most_text = "farther than 1 km",
                    .is_optional = i >= 3,
                    .usual_names = usual[i % 3],
                    .example_unit = ":mm"};
    }
    kinds[6] = {.what = "time",
                .units = time_units,
                .most = latest_s,
                .most_text = "too late",
                .short_name = "t",
                .is_optional = true};
    return kinds;
}

/// The rows of a table, one after the other.
class Rows {
public:
    Rows(base::TableLayout layout, const RecordingFormat& format)
        : layout_{std::move(layout)}, format_{format}
    {
        const auto& columns = layout_.columns;
        const bool are_two = columns[3] && columns[4] && columns[5];
        tracks_.resize(are_two ? 2 : 1);
    }

    [[nodiscard]] std::uint64_t count() const { return tracks_.front().rows; }

    [[nodiscard]] base::Result<void> add(std::span<const std::string_view> cells, std::size_t line)
    {
        if (cells.size() != layout_.cells)
            return base::fail(refusal_of_cells(cells.size(), layout_));
        const auto time = time_of(cells);
        if (!time) return tl::unexpected{time.error()};
        if (count() > 0 && !(*time > last_s_)) {
            return base::fail(
                fmt::format("the time {} s does not come after {} s", *time, last_s_));
        }
        if (count() > 0) steps_s_.push_back(*time - last_s_);
        last_s_ = *time;
        for (std::size_t person = 0; person < tracks_.size(); ++person) {
            ++tracks_[person].rows;
            const auto place = place_of(cells, person);
            if (!place) return tl::unexpected{place.error()};
            if (*place) tracks_[person].samples.push_back({*time, **place, line});
        }
        return {};
    }

    [[nodiscard]] base::Result<std::vector<Track>> finished()
    {
        for (Track& track : tracks_) {
            if (track.samples.size() < 2)
                return base::fail("a hand was seen in fewer than two rows");
            track.rate_hz = format_.rate_hz ? *format_.rate_hz : 1.0 / median_step_s();
        }
        return std::move(tracks_);
    }

private:
    /// Returns the time of a row: from its column, or from the row's number.
    [[nodiscard]] base::Result<double> time_of(std::span<const std::string_view> cells)
    {
        const auto& column = layout_.columns[6];
        if (!column) return static_cast<double>(count()) / *format_.rate_hz;
        auto number = numbers_.read(cells[column->place], *column);
        if (!number) return number;
        const double time_s = *number * column->factor;
        if (std::abs(time_s) > column->most)
            return base::fail(fmt::format("{} {} is {}", column->name, *number, column->most_text));
        return time_s;
    }

    /// Returns the position of a person's hand; the inner nullopt: the hand was not seen.
    [[nodiscard]] base::Result<std::optional<glm::dvec3>>
    place_of(std::span<const std::string_view> cells, std::size_t person)
    {
        glm::dvec3 place{0.0};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const base::NumberColumn& column = *layout_.columns[3 * person + axis];
            const auto cell = cells[column.place];
            if (base::says_lost(cell)) return std::nullopt;
            const auto number = numbers_.read(cell, column);
            if (!number) return tl::unexpected{number.error()};
            const double metres = *number * column.factor;
            if (std::abs(metres) > column.most) {
                return base::fail(
                    fmt::format("{} {} is {}", column.name, *number, column.most_text));
            }
            place[static_cast<int>(axis)] = metres;
        }
        return format_.axes.to_scene(place);
    }

    [[nodiscard]] double median_step_s()
    {
        const auto middle = steps_s_.begin() + static_cast<std::ptrdiff_t>(steps_s_.size() / 2);
        std::nth_element(steps_s_.begin(), middle, steps_s_.end());
        return *middle;
    }

    base::TableLayout layout_;
    const RecordingFormat& format_;
    base::NumberReader numbers_;
    std::vector<Track> tracks_;
    std::vector<double> steps_s_; // times between rows
    double last_s_ = 0.0;
};

base::Result<std::vector<Track>> read_rows(base::LineReader& lines, const RecordingFormat& format)
{
    const auto layout = find_layout(lines, kinds_of(format), format.columns);
    if (!layout) {
        std::ignore = lines.next();
        return lines.fail(layout.error().message);
    }
    if (!layout->columns[6] && !format.rate_hz) {
        std::ignore = lines.next();
        return lines.fail("no column is named time_s or time_ms: say how many rows a second has, "
                          "such as --rate 120Hz, or which column it is, such as --columns "
                          "\"time=stamp:s\"");
    }
    base::Cells cells{{layout->separator, true}};
    if (layout->has_header) std::ignore = lines.next_cells(cells);
    Rows rows{*layout, format};
    for (;;) {
        const auto line = lines.next_cells(cells);
        if (!line) return tl::unexpected{line.error()};
        if (!*line) break;
        if (rows.count() == recording_rows_max)
            return lines.fail(fmt::format("more than {} rows: cut the file", recording_rows_max));
        if (const auto added = rows.add(**line, lines.number()); !added)
            return lines.fail(added.error().message);
    }
    auto tracks = rows.finished();
    if (!tracks) return lines.fail(tracks.error().message);
    return tracks;
}

/// Returns the names "px,py,pz" as "x=px,y=py,z=pz"; nullopt: this number of names is not allowed.
std::optional<std::string> with_meanings(std::string_view names)
{
    std::vector<std::string_view> words;
    while (!names.empty()) {
        const auto comma = std::min(names.find(','), names.size());
        words.push_back(base::trimmed(names.substr(0, comma)));
        names.remove_prefix(std::min(comma + 1, names.size()));
    }
    const std::size_t count = words.size();
    if (count != 3 && count != 4 && count != 6 && count != 7) return std::nullopt;
    const std::size_t first = count == 4 || count == 7 ? 0 : 1;
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text += fmt::format("{}{}={}", i == 0 ? "" : ",", meanings[first + i], words[i]);
    return text;
}

} // namespace

base::Result<Axes> parse_axes(std::string_view text)
{
    const auto refuse = [&] {
        return base::fail(fmt::format("'{}' does not say what is right, up and toward the user: "
                                      "write x, y and z once each, with or without a minus, such "
                                      "as x,z,-y",
                                      base::shortened(text)));
    };
    Axes axes;
    std::array<bool, 3> is_used{};
    std::string_view rest = text;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto comma = std::min(rest.find(','), rest.size());
        auto word = base::trimmed(rest.substr(0, comma));
        if ((comma == rest.size()) != (i == 2)) return refuse();
        rest.remove_prefix(std::min(comma + 1, rest.size()));
        const bool is_minus = word.starts_with('-');
        if (is_minus || word.starts_with('+')) word.remove_prefix(1);
        if (word.size() != 1 || word[0] < 'x' || word[0] > 'z') return refuse();
        axes.of.at(i) = word[0] - 'x';
        axes.sign[static_cast<int>(i)] = is_minus ? -1.0 : 1.0;
        if (std::exchange(is_used.at(static_cast<std::size_t>(axes.of.at(i))), true))
            return refuse();
    }
    return axes;
}

std::string to_text(const Axes& axes)
{
    std::string text;
    for (const int i : {0, 1, 2}) {
        if (i > 0) text += ',';
        if (axes.sign[i] < 0.0) text += '-';
        text += static_cast<char>('x' + axes.of.at(static_cast<std::size_t>(i)));
    }
    return text;
}

base::Result<base::Columns> parse_hand_columns(std::string_view text)
{
    if (text.find('=') != std::string_view::npos || base::trimmed(text).empty())
        return base::parse_columns(text, meanings);
    const auto named = with_meanings(text);
    if (!named) {
        return base::fail(fmt::format("'{}' has neither 3 names, of x, y and z, nor 6, of two "
                                      "people, with or without that of the time before them",
                                      base::shortened(text)));
    }
    return base::parse_columns(*named, meanings);
}

base::Result<double> parse_length_unit(std::string_view text)
{
    for (const base::ColumnUnit& unit : length_units)
        if (text == unit.name) return unit.factor;
    return base::fail(fmt::format("'{}': use m, cm or mm", base::shortened(text)));
}

base::Result<std::vector<Track>> read_recording(std::string_view text, const std::string& source,
                                                const RecordingFormat& format)
{
    base::LineReader lines{text};
    auto tracks = read_rows(lines, format);
    if (!tracks) return base::fail(fmt::format("{}: {}", source, tracks.error().message));
    return tracks;
}

} // namespace hapnet::lab::hands
