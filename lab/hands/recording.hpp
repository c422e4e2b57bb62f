// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/columns.hpp"
#include "proto/base/result.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::hands {

/// The axes of a recording that become x (right), y (up) and z (toward the user) of the scene:
/// "x,z,-y".
struct Axes {
    std::array<int, 3> of{0, 1, 2}; // the recording's axes for x, y and z; 0 is its x axis
    glm::dvec3 sign{1.0};

    [[nodiscard]] glm::dvec3 to_scene(const glm::dvec3& recorded) const
    {
        return sign * glm::dvec3{recorded[of[0]], recorded[of[1]], recorded[of[2]]};
    }

    friend bool operator==(const Axes&, const Axes&) = default;
};

/// Reads axes such as "x,z,-y", each axis once. The error says what would be right.
[[nodiscard]] base::Result<Axes> parse_axes(std::string_view text);
[[nodiscard]] std::string to_text(const Axes& axes);

/// Reads the columns of a table of motion, as base::parse_columns() does: "time=stamp:s, x=px:mm,
/// ..., b.x=qx:mm". They are time, x, y and z, and b.x, b.y and b.z for a second person in the same
/// table. Alternatively reads 3, 4, 6 or 7 names alone in this order, with or without time.
[[nodiscard]] base::Result<base::Columns> parse_hand_columns(std::string_view text);

/// Returns the length of one m, cm or mm in metres.
[[nodiscard]] base::Result<double> parse_length_unit(std::string_view text);

/// The format in which a table of recorded motion is read.
struct RecordingFormat {
    base::Columns columns{};
    /// Metres per unit for columns without a unit; nullopt: every column must have a unit.
    std::optional<double> m_per_unit{};
    std::optional<double> rate_hz{}; // rows per second; nullopt: the table has times
    Axes axes{};
};

/// The position of a hand at a time, in the axes of the scene.
struct Sample {
    double time_s = 0.0; // time on the clock of the recording
    glm::dvec3 place_m{0.0};
    std::size_t line = 0; // number of the line in the file
};

/// The recorded motion of one person in a table.
struct Track {
    /// At least two samples, in the order of time. Rows without a position are left out.
    std::vector<Sample> samples;
    std::uint64_t rows = 0; // number of all rows, with or without a position
    double rate_hz = 0.0;   // rows per second: as stated, or from the median time between rows
};

inline constexpr std::size_t recording_rows_max = 4'000'000;

/// Reads a table of recorded motion of one person, or of two. Its columns are x, y and z, named
/// "x_mm" and so on or as the format defines, and optionally time. Tables are those that
/// base::find_layout() knows. In a row without a number in one of the three columns, the hand was
/// not seen. Errors begin with "SOURCE: line N: ".
[[nodiscard]] base::Result<std::vector<Track>>
read_recording(std::string_view text, const std::string& source, const RecordingFormat& format);

} // namespace hapnet::lab::hands
