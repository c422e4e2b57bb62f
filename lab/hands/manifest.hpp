// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"
#include "proto/base/value_kind.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::hands {

// The manifest.json of a folder of trials: docs/formats/hands.md.

/// The imported recording of one person.
struct ImportedHand {
    std::string script;
    std::string source;
    std::uint64_t rows = 0;
    std::uint64_t gaps = 0;
    double longest_gap_ms = 0.0;
    double gaps_ms = 0.0;
    double recorded_speed_max_mm_s = 0.0;
    double speed_max_mm_s = 0.0;
};
constexpr auto fields_of(base::Tag<ImportedHand>)
{
    using H = ImportedHand;
    return base::fields(
        "imported hand",
        base::member("script", &H::script, "File in this folder: a script at 1 kHz."),
        base::member("source", &H::source, "Name of the recording."),
        base::member("rows", &H::rows, "Rows of the recording, those without a place included."),
        base::member("gaps", &H::gaps,
                     "Number of times that the hand was not seen for more than one and a half "
                     "rows, within what was taken. The motion goes on smoothly through them."),
        base::member("longest_gap_ms", &H::longest_gap_ms, "Longest of them.").rounded(3),
        base::member("gaps_ms", &H::gaps_ms, "All of them together.").rounded(3),
        base::member("recorded_speed_max_mm_s", &H::recorded_speed_max_mm_s,
                     "Highest speed of the person, after smoothing.")
            .rounded(3),
        base::member("speed_max_mm_s", &H::speed_max_mm_s,
                     "Highest speed of the script, after scaling.")
            .rounded(3));
}

/// A motion of one or two people, and the changes that the import made.
struct ImportedTrial {
    std::string subject;
    std::string trial;
    double duration_s = 0.0;
    double rate_hz = 0.0;
    double from_s = 0.0;
    double smooth_hz = 0.0;
    std::string axes;
    double scale = 1.0;
    std::string scale_limited_by;
    double press_mm = 0.0;
    double meeting_s = 0.0;
    double touching_share = 0.0;
    double speed_limit_mm_s = 0.0;
    ImportedHand a;
    std::optional<ImportedHand> b;
};
constexpr auto fields_of(base::Tag<ImportedTrial>)
{
    using T = ImportedTrial;
    return base::fields(
        "imported trial",
        base::member("subject", &T::subject, "Who moved: a person, or two who moved together."),
        base::member("trial", &T::trial, "Which of the subject's trials."),
        base::member("duration_s", &T::duration_s, "Length of the scripts.").rounded(3),
        base::member("rate_hz", &T::rate_hz, "Rows a second of the recording.").rounded(3),
        base::member("from_s", &T::from_s,
                     "Where in the recording the scripts begin: from its first row, or where both "
                     "people were seen.")
            .rounded(6),
        base::member("smooth_hz", &T::smooth_hz,
                     "Cutoff of the smoothing: a Butterworth filter of fourth order with zero "
                     "phase; half the power is left there."),
        base::member("axes", &T::axes,
                     "Axes of the recording that became right, up and toward the user."),
        base::member("scale", &T::scale, "Factor that all distances were multiplied by."),
        base::member("scale_limited_by", &T::scale_limited_by,
                     "Limit that kept the scale from being larger: the workspace along an axis, or "
                     "the speed; empty: the scale was given, or is 1."),
        base::member("press_mm", &T::press_mm,
                     "How deep in the cube the hands mean to be where they are nearest."),
        base::member("meeting_s", &T::meeting_s, "When that is, from the beginning of the scripts.")
            .rounded(3),
        base::member("touching_share", &T::touching_share,
                     "Share of the time in which the hands mean to be so near to each other that "
                     "both touch the cube; of one hand, so far to the right that it does.")
            .rounded(4),
        base::member("speed_limit_mm_s", &T::speed_limit_mm_s, "Speed that no script exceeds."),
        base::member("a", &T::a, "The person who acts as A."),
        base::member("b", &T::b, "The person who acts as B; null: a simulated hand does."));
}

/// A population: the trials of a folder.
struct Manifest {
    std::string kind{"hands"};
    std::uint64_t version = 1;
    std::vector<ImportedTrial> trials;
};
constexpr auto fields_of(base::Tag<Manifest>)
{
    using M = Manifest;
    return base::fields("hands", base::member("kind", &M::kind, "`hands`"),
                        base::member("version", &M::version, "Version of this format: 1."),
                        base::member("trials", &M::trials, "In the order of their import."));
}

inline constexpr std::string_view manifest_name = "manifest.json";

/// Reads a manifest. `source` names it in errors, which say what the text is instead.
[[nodiscard]] base::Result<Manifest> parse_manifest(std::string_view text,
                                                    const std::string& source);
[[nodiscard]] std::string to_text(const Manifest& manifest);

/// Adds a trial. It replaces the one that has the same subject and name.
void put(Manifest& manifest, ImportedTrial trial);

/// True if the name can be that of a subject, of a trial or of one of its files: letters, digits, -
/// and _, at most 200 characters.
[[nodiscard]] bool is_plain_name(std::string_view name);

} // namespace hapnet::lab::hands
