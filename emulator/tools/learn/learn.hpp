// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/profile.hpp"
#include "emulator/tools/learn/learned_regime.hpp"
#include "emulator/tools/learn/likeness.hpp"
#include "emulator/tools/learn/measured_table.hpp"
#include "emulator/tools/learn/measurement.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/names.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator::tools {

/// The form in which the delays of a direction were learned.
enum class LearnedForm : std::uint8_t {
    laws,    // drawn by a law with the parameters that were found
    regimes, // drawn by the laws of several regimes
    table,   // drawn from the values that were measured
    trace,   // replayed as measured
};
constexpr auto names_of(base::Tag<LearnedForm>)
{
    return base::names("laws", "regimes", "table", "trace");
}

/// The result of learning for one direction, or for a round trip.
struct WayLesson {
    std::string way{};
    LearnedForm form = LearnedForm::laws;
    std::vector<LearnedRegime> regimes{}; // in the form LearnedForm::regimes
    std::optional<Likeness> likeness{};
};
constexpr auto fields_of(base::Tag<WayLesson>)
{
    using W = WayLesson;
    return base::fields(
        "learned way", base::member("way", &W::way, "`round trip`, `up` or `down`."),
        base::member("form", &W::form,
                     "`laws`: drawn by a law. `regimes`: by the laws of several regimes. `table`: "
                     "drawn from the values that were measured. "
                     "`trace`: replayed."),
        base::member("regimes", &W::regimes,
                     "Its regimes, as a list of [these](#a-regime-that-was-learned); empty in "
                     "another form."),
        base::member("likeness", &W::likeness,
                     "How like the second half is what was learned from the first half alone, in "
                     "this form. null: fewer than 400 datagrams."));
}

/// A profile that reproduces the measured delays and losses, and its reliability.
struct Lesson {
    Profile profile;
    std::vector<std::string> remarks; // for people, one on each line
    std::vector<std::string> plots;   // for a terminal, several lines each
    std::vector<WayLesson> ways;
};

/// The output of --json.
struct LearnReport {
    const Lesson* lesson = nullptr;

    [[nodiscard]] std::string profile() const;
};
constexpr auto fields_of(base::Tag<LearnReport>)
{
    using L = LearnReport;
    return base::fields(
        "lesson",
        base::computed<L>(
            "profile", [](const L& one) { return one.profile(); },
            "The profile as TOML, without comments."),
        base::computed<L>(
            "ways", [](const L& one) -> const auto& { return one.lesson->ways; },
            "What was learned of each way, as a list of [these](#a-way-that-was-learned)."),
        base::computed<L>(
            "remarks", [](const L& one) -> const auto& { return one.lesson->remarks; },
            "What `learn` says for people, one sentence or figure each."));
}

struct LearnSettings {
    /// Files from which laws read the measured values, by the name of the direction. Empty: no file
    /// can be named.
    std::map<std::string, MeasuredTable> tables{};
    bool replays = false; // replay traces even if laws would fit
};

/// Finds the laws of a measurement: delays, their correlation in time, losses, reordering. A law of
/// delays is rejected if delays drawn from it would look like the measured ones at most one time in
/// a thousand. If all laws are rejected, the nearest is taken, and a remark says so. If the laws of
/// the first half do not reproduce the delays of that half (see is_near), regimes replace them;
/// their number is the one with the least BIC there. If regimes do not reproduce them either, the
/// measured values replace them: drawn, or replayed if their correlation requires it. The likeness
/// of the choice to the unseen second half is reported. Then all rows are learned in the chosen
/// form. The error: nothing arrived, or a table cannot be read.
[[nodiscard]] base::Result<Lesson> learn(const Measurement& measurement,
                                         const LearnSettings& settings = {});

/// Returns the profile as TOML, with the remarks as comments before it.
[[nodiscard]] std::string to_text(const Lesson& lesson);

} // namespace hapnet::emulator::tools
