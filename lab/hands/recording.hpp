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

/// Axes of a recording that become x (right), y (up), z (toward the user) of the scene: "x,z,-y".
struct Axes {
    std::array<int, 3> of{0, 1, 2}; // axes of the recording for x, y, z: 0 is its x
    glm::dvec3 sign{1.0};

    [[nodiscard]] glm::dvec3 to_scene(const glm::dvec3& recorded) const
    {
        return sign * glm::dvec3{recorded[of[0]], recorded[of[1]], recorded[of[2]]};
    }

    friend bool operator==(const Axes&, const Axes&) = default;
};

/// "x,z,-y": each axis once. The error says what is right.
[[nodiscard]] base::Result<Axes> parse_axes(std::string_view text);
[[nodiscard]] std::string to_text(const Axes& axes);

/// "time=stamp:s, x=px:mm, ..., b.x=qx:mm": time, x, y and z, and of a second person in the same
/// table b.x, b.y and b.z, as base::parse_columns() reads them; or the names alone in this order,
/// with or without time: 3, 4, 6 or 7 of them.
[[nodiscard]] base::Result<base::Columns> parse_hand_columns(std::string_view text);

/// Metres in one of m, cm and mm.
[[nodiscard]] base::Result<double> parse_length_unit(std::string_view text);

/// The format in which a table of recorded motion is read.
struct RecordingFormat {
    base::Columns columns{};
    /// Metres of 1 in columns that say no unit; nullopt: they have to.
    std::optional<double> m_per_unit{};
    std::optional<double> rate_hz{}; // rows per second; nullopt: the table has times
    Axes axes{};
};

/// The place of a hand at a time, in the axes of the scene.
struct Sample {
    double time_s = 0.0; // time on the clock of the recording
    glm::dvec3 place_m{0.0};
    std::size_t line = 0; // number of the line in the file
};

/// The recorded motion of one person in a table.
struct Track {
    /// At least two, in the order of time. Rows without a place are left out.
    std::vector<Sample> samples;
    std::uint64_t rows = 0; // number of all rows, with or without a place
    double rate_hz = 0.0;   // rows per second: as stated, or by the median time between rows
};

inline constexpr std::size_t recording_rows_max = 4'000'000;

/// Reads a table of recorded motion of one person, or of two: columns x, y and z, named "x_mm" and
/// so on, or as the format says, and perhaps time. Tables are those that base::find_layout() knows.
/// A row without a number in one of the three is one in which the hand was not seen. Errors begin
/// with "SOURCE: line N: ".
[[nodiscard]] base::Result<std::vector<Track>>
read_recording(std::string_view text, const std::string& source, const RecordingFormat& format);

} // namespace hapnet::lab::hands
