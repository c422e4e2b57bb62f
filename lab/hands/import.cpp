// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/import.hpp"

#include "lab/hands/motion.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::hands {

namespace {

/// The data of one file about one person.
struct Person {
    std::string source;
    Track track;
};

/// The part of a recording that is imported, on the clock of the recording.
struct Stretch {
    double zero_s = 0.0; // time of the first row
    double from_s = 0.0;
    double to_s = 0.0;

    [[nodiscard]] std::size_t ticks() const
    {
        constexpr double slack = 1e-6; // allowance for rounding, in ticks
        return static_cast<std::size_t>((to_s - from_s) * motion_rate_hz + slack) + 1;
    }
};

base::Result<std::vector<Person>> people_in(std::span<const TextFile> files,
                                            const RecordingFormat& format)
{
    if (files.empty() || files.size() > 2) {
        return base::fail(fmt::format("{} files: name one, or one of A and one of B; import each "
                                      "trial by itself into the same folder",
                                      files.size()));
    }
    std::vector<Person> people;
    for (const TextFile& file : files) {
        auto tracks = read_recording(file.text, file.name, format);
        if (!tracks) return tl::unexpected{tracks.error()};
        if (files.size() == 2 && tracks->size() == 2) {
            return base::fail(file.name + ": it has two people: name it alone");
        }
        for (Track& track : *tracks) people.push_back({file.name, std::move(track)});
    }
    return people;
}

base::Result<Stretch> stretch_of(const std::vector<Person>& people, const ImportRules& rules)
{
    Stretch stretch;
    stretch.zero_s = people[0].track.samples.front().time_s;
    stretch.from_s = stretch.zero_s;
    stretch.to_s = people[0].track.samples.back().time_s;
    for (const Person& person : people) {
        const auto& samples = person.track.samples;
        stretch.zero_s = std::min(stretch.zero_s, samples.front().time_s);
        stretch.from_s = std::max(stretch.from_s, samples.front().time_s);
        stretch.to_s = std::min(stretch.to_s, samples.back().time_s);
    }
    if (rules.from_s) stretch.from_s = std::max(stretch.from_s, stretch.zero_s + *rules.from_s);
    if (rules.to_s) stretch.to_s = std::min(stretch.to_s, stretch.zero_s + *rules.to_s);
    constexpr double shortest_s = 1.0;
    constexpr double longest_s = 597.0; // a session lasts 600 s at most, hands off included
    const double length_s = stretch.to_s - stretch.from_s;
    if (length_s >= shortest_s && length_s <= longest_s) return stretch;
    return base::fail(
        fmt::format("{}: {:.3f} s in which {}: a script lasts 1 s to 597 s: choose "
                    "another stretch by --from and --to",
                    people[0].source, std::max(length_s, 0.0),
                    people.size() > 1 ? "both hands were seen" : "the hand was seen"));
}

/// Reports faults that no smoothing can repair.
base::Result<void> check(const Person& person, const Stretch& stretch, const ImportRules& rules)
{
    const double rate_hz = person.track.rate_hz;
    if (rules.smooth_hz > 0.5 * rate_hz) {
        return base::fail(fmt::format("{}: {:g} rows a second hold nothing above {:g} Hz: smooth "
                                      "at that or less",
                                      person.source, rate_hz, 0.5 * rate_hz));
    }
    const Gaps gaps = gaps_in(person.track, stretch.from_s, stretch.to_s);
    if (gaps.longest_s <= rules.longest_gap_s) return {};
    return base::fail(fmt::format(
        "{}: line {}: the hand was not seen for {:.0f} ms, from {:.3f} s on, and {:.0f} ms are "
        "allowed: take a stretch without that by --from and --to, or allow more by --longest-gap",
        person.source, gaps.line_after_longest, 1e3 * gaps.longest_s,
        gaps.begin_of_longest_s - stretch.zero_s, 1e3 * rules.longest_gap_s));
}

/// Returns the name of a file without its folder and ending, as the name of a trial.
std::string stem_of(std::string_view file)
{
    file.remove_prefix(std::min(file.rfind('/') + 1, file.size()));
    file = file.substr(0, file.rfind('.'));
    std::string stem;
    for (const char c : file) stem += is_plain_name({&c, 1}) ? c : '-';
    return stem.empty() ? "1" : stem;
}

base::Result<void> check_names(const ImportedTrial& trial)
{
    for (const auto& [what, name] :
         {std::pair{"--subject", &trial.subject}, std::pair{"--trial", &trial.trial}}) {
        if (is_plain_name(*name)) continue;
        return base::fail(fmt::format("{} '{}': a name has letters, digits, - and _ only", what,
                                      base::shortened(*name)));
    }
    return {};
}

ImportedHand hand_of(const Person& person, const Stretch& stretch)
{
    const Gaps gaps = gaps_in(person.track, stretch.from_s, stretch.to_s);
    ImportedHand hand;
    hand.source = person.source;
    hand.rows = person.track.rows;
    hand.gaps = gaps.count;
    hand.longest_gap_ms = 1e3 * gaps.longest_s;
    hand.gaps_ms = 1e3 * gaps.total_s;
    return hand;
}

std::string told(std::string_view who, const ImportedHand& hand, double limit_mm_s)
{
    return fmt::format("  {}: {} rows of {}, {} gap{}{}; {:.0f} mm/s at most, scaled from {:.0f} "
                       "mm/s (limit {:.0f} mm/s)\n",
                       who, hand.rows, hand.source, hand.gaps, hand.gaps == 1 ? "" : "s",
                       hand.gaps == 0
                           ? ""
                           : fmt::format(" filled, {:.0f} ms together, the longest {:.0f} ms",
                                         hand.gaps_ms, hand.longest_gap_ms),
                       hand.speed_max_mm_s, hand.recorded_speed_max_mm_s, limit_mm_s);
}

} // namespace

base::Result<Imported> import_hands(std::span<const TextFile> files, const ImportRules& rules)
{
    auto people = people_in(files, rules.format);
    if (!people) return tl::unexpected{people.error()};
    const auto stretch = stretch_of(*people, rules);
    if (!stretch) return tl::unexpected{stretch.error()};
    ImportedTrial trial;
    trial.subject = rules.subject;
    trial.trial = rules.trial.empty() ? stem_of(files[0].name) : rules.trial;
    if (const auto good = check_names(trial); !good) return tl::unexpected{good.error()};
    std::vector<Motion> motions;
    for (std::size_t i = 0; i < people->size(); ++i) {
        const Person& person = (*people)[i];
        if (const auto good = check(person, *stretch, rules); !good)
            return tl::unexpected{good.error()};
        motions.push_back(resampled(person.track, stretch->from_s, stretch->ticks()));
        smooth(motions.back(), rules.smooth_hz);
        (i == 0 ? trial.a : trial.b.emplace()) = hand_of(person, *stretch);
    }
    trial.rate_hz = people->front().track.rate_hz;
    trial.from_s = stretch->from_s - stretch->zero_s;
    trial.smooth_hz = rules.smooth_hz;
    trial.axes = to_text(rules.format.axes);
    auto imported = fitted_trial(std::move(trial), std::move(motions), rules.fit);
    if (!imported)
        return base::fail(fmt::format("{}: {}", files[0].name, imported.error().message));
    return imported;
}

base::Result<Imported> fitted_trial(ImportedTrial trial, std::vector<Motion> motions,
                                    const FitRules& rules)
{
    base::ensure(motions.size() == (trial.b ? 2U : 1U));
    const auto hand = [&](std::size_t i) -> ImportedHand& { return i == 0 ? trial.a : *trial.b; };
    for (std::size_t i = 0; i < motions.size(); ++i)
        hand(i).recorded_speed_max_mm_s = 1e3 * speed_max_of(motions[i]);
    const auto fitted = fit(motions, rules);
    if (!fitted) return tl::unexpected{fitted.error()};
    std::vector<TextFile> scripts;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        hand(i).speed_max_mm_s = 1e3 * speed_max_of(motions[i]);
        hand(i).script = fmt::format("{}-{}-{}.csv", trial.subject, trial.trial, "ab"[i]);
        scripts.push_back({hand(i).script, script_text(motions[i])});
    }
    trial.duration_s = static_cast<double>(motions[0].size() - 1) / motion_rate_hz;
    trial.scale = fitted->scale;
    trial.scale_limited_by = fitted->limited_by;
    trial.press_mm = 1e3 * rules.press_m;
    trial.meeting_s = fitted->meeting_s;
    trial.touching_share = fitted->touching_share;
    trial.speed_limit_mm_s = 1e3 * rules.speed_max_m_per_s;
    return Imported{std::move(trial), std::move(scripts)};
}

std::string told(const ImportedTrial& trial)
{
    std::string text = fmt::format(
        "subject {}, trial {}: {:.3f} s, smoothed at {:g} Hz, scaled by {:.4g}{}\n", trial.subject,
        trial.trial, trial.duration_s, trial.smooth_hz, trial.scale,
        trial.scale_limited_by.empty() ? "" : fmt::format(" ({})", trial.scale_limited_by));
    text += told("A", trial.a, trial.speed_limit_mm_s);
    if (trial.b) text += told("B", *trial.b, trial.speed_limit_mm_s);
    text += fmt::format("  nearest at {:.3f} s; near enough to touch the cube for {:.0f} % of the "
                        "time\n",
                        trial.meeting_s, 1e2 * trial.touching_share);
    return text;
}

} // namespace hapnet::lab::hands
