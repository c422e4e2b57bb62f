// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/signal_history.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/random.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::device {

/// A hand on a stylus as a linear impedance: m h'' + b h' + k (h - intention) = force. The mass
/// contains the device's apparent 45 g. Nominal values are for a relaxed pen grip; measured arms
/// have 0.554 kg, 6.45 N s/m, 135 N/m (Scientific Reports 6:18004). Damping and stiffness rise with
/// the grip (Hasser, Cutkosky 2002).
struct HandImpedance {
    double mass_kg = 0.20;
    double damping_ns_per_m = 5.0;
    double stiffness_n_per_m = 200.0;

    friend bool operator==(const HandImpedance&, const HandImpedance&) = default;
};
constexpr auto fields_of(base::Tag<HandImpedance> /*struct*/)
{
    // These ranges are wider than those of hands. Within them a step of 2 ms is short compared with
    // a hand's motion.
    return base::fields(
        "hand",
        base::field("mass", &HandImpedance::mass_kg, base::Quantity{base::mass_kind, 0.02, 10.0},
                    "of the hand, with the device's 45 g"),
        base::field("damping", &HandImpedance::damping_ns_per_m,
                    base::Quantity{base::damping_kind, 0.0, 100.0}, "of the grip"),
        base::field("stiffness", &HandImpedance::stiffness_n_per_m,
                    base::Quantity{base::stiffness_kind, 1.0, 5000.0}, "of the grip"));
}

/// An involuntary motion along x: a sum of three sines, each a third of the amplitude, whose
/// frequencies and phases come from the seed.
struct InvoluntaryMotion {
    double amplitude_m = 0.0;
    double least_hertz = 0.0;
    double most_hertz = 0.0;

    friend bool operator==(const InvoluntaryMotion&, const InvoluntaryMotion&) = default;
};
constexpr auto fields_of(base::Tag<InvoluntaryMotion> /*struct*/)
{
    constexpr base::Quantity frequency{base::frequency_kind, 0.0, 100.0};
    return base::fields(
        "involuntary-motion",
        base::field("amplitude", &InvoluntaryMotion::amplitude_m,
                    base::Quantity{base::length_kind, 0.0, 0.1},
                    "amplitude along x, of three sines together"),
        base::field("from", &InvoluntaryMotion::least_hertz, frequency, "lowest frequency"),
        base::field("to", &InvoluntaryMotion::most_hertz, frequency, "highest frequency"));
}

/// The stretch reflex: the hand responds to its deviation from its intention a time `delay` ago,
/// with `gain` times its own stiffness. Spinal and long-loop reflexes take 30 to 60 ms (general
/// knowledge).
struct Reflex {
    double gain = 0.0; // 0: no reflex
    base::Duration delay{std::chrono::milliseconds{50}};

    friend bool operator==(const Reflex&, const Reflex&) = default;
};
constexpr auto fields_of(base::Tag<Reflex> /*struct*/)
{
    return base::fields("reflex",
                        base::field("gain", &Reflex::gain, base::Number{0.0, 10.0},
                                    "share of the hand's stiffness; 0: no reflex"),
                        base::field("delay", &Reflex::delay,
                                    base::Time{base::Duration{0}, SignalHistory::delay_max},
                                    "from the stretch to the reaction"));
}

/// The intent. If a task requires a force, the intention moves further while force is missing, by
/// `gain` per second and newton, at most 20 mm. The missing force is computed from the force felt
/// `delay` ago, smoothed by a first-order low-pass. Reactions to touch take about 150 ms, and to
/// sight 200 ms (general knowledge). With the 143 N/m of a nominal hand's contact the force
/// recovers with a time constant of 0.7 s.
struct Intent {
    double gain_m_per_ns = 0.010; // 0: no reaction
    double cutoff_hertz = 1.5;
    base::Duration delay{std::chrono::milliseconds{150}};

    friend bool operator==(const Intent&, const Intent&) = default;
};
constexpr auto fields_of(base::Tag<Intent> /*struct*/)
{
    return base::fields("will",
                        base::field("gain", &Intent::gain_m_per_ns,
                                    base::Quantity{base::mobility_kind, 0.0, 1.0},
                                    "speed of the intended position per newton; 0: no reaction"),
                        base::field("cutoff", &Intent::cutoff_hertz,
                                    base::Quantity{base::frequency_kind, 0.01, 100.0},
                                    "of the low-pass on that force"),
                        base::field("delay", &Intent::delay,
                                    base::Time{base::Duration{0}, SignalHistory::delay_max},
                                    "from the force to the reaction"));
}

/// The search of a hand for a body that it intends to touch and does not feel. After the time
/// `after` without a force, its intention moves toward the body at `speed`, at most `reach` beyond
/// the task's aim. It stops at the first touch, without a reaction time, and stays there until the
/// task's aim has come as far. When the task does not intend a touch, the intention goes back. T1,
/// T2, T3 and T7; chosen, not measured.
struct Search {
    double speed_m_per_s = 0.0; // 0: the hand does not search
    base::Duration after{std::chrono::milliseconds{400}};
    double reach_m = 0.060;

    friend bool operator==(const Search&, const Search&) = default;
};
constexpr auto fields_of(base::Tag<Search> /*struct*/)
{
    return base::fields(
        "search",
        base::field("speed", &Search::speed_m_per_s, base::Quantity{base::speed_kind, 0.0, 1.0},
                    "speed of the intended position; 0: does not look"),
        base::field("after", &Search::after,
                    base::Time{base::Duration{0}, std::chrono::seconds{10}},
                    "so long without a force"),
        base::field("reach", &Search::reach_m, base::Quantity{base::length_kind, 0.0, 0.2},
                    "how far beyond the task's place"));
}

/// A simulated person at a device: how the hand yields and how its intent wavers, reacts and lags.
/// Not a human being: a linear hand with scripted intentions.
struct Operator {
    std::string name = "nominal";
    HandImpedance hand{};
    InvoluntaryMotion wander{.amplitude_m = 2e-3, .least_hertz = 0.3, .most_hertz = 0.9};
    InvoluntaryMotion tremor{
        .amplitude_m = 1e-4, .least_hertz = 8.0, .most_hertz = 12.0}; // physiological tremor
    /// Standard deviation of the hand's force as a share of that force, 1 to 10 Hz. Isometric
    /// forces have 2 to 4 % (Jones, Hamilton, Wolpert 2002).
    base::Probability force_noise{};
    Reflex reflex{};
    Intent intent{};
    Search search{};

    friend bool operator==(const Operator&, const Operator&) = default;
};
constexpr auto fields_of(base::Tag<Operator> /*struct*/)
{
    return base::fields(
        "operator", base::field("name", &Operator::name, "for reports and records"),
        base::part(&Operator::hand), base::field("wander", &Operator::wander, "slow unrest"),
        base::field("tremor", &Operator::tremor, "fast unrest"),
        base::field("force_noise", &Operator::force_noise,
                    "standard deviation of the hand's force relative to that force, 1 to 10 Hz"),
        base::field("reflex", &Operator::reflex, "stretch reflex"),
        base::field("will", &Operator::intent, "reaction to missing force"),
        base::field("search", &Operator::search,
                    "looks for a body that is not where it should be"));
}

/// The names of the presets: three grips with wander, tremor and intent, and the nominal grip with
/// more of them, force noise and a stretch reflex.
inline constexpr auto operator_names = base::names("relaxed", "nominal", "firm", "lifelike");
[[nodiscard]] base::Result<Operator> operator_named(std::string_view name);

/// Reads a preset's name, or a table with `preset = "nominal"` and the differing parameters;
/// nullopt when an error was reported.
[[nodiscard]] std::optional<Operator> read_operator(const base::Node& node, base::Reading& reading);

/// Reads a text that consists of the keys of that table. `source` names it in errors, which begin
/// with "SOURCE:LINE:COLUMN: ".
[[nodiscard]] base::Result<Operator> parse_operator(std::string_view text,
                                                    const std::string& source);

/// Returns the preset of that name, or else reads the file with `open`.
[[nodiscard]] base::Result<Operator> load_operator(const std::string& file_or_name,
                                                   const base::OpenFile& open);

/// Returns every parameter as TOML. Reading it gives the same operator.
[[nodiscard]] std::string print_operator(const Operator& person);

/// Returns one of `of` operators that together distribute every parameter evenly over +-30 % of
/// that of `person`: a latin hypercube (McKay, Beckman, Conover 1979). A pure function of its
/// arguments; 0 stays 0.
[[nodiscard]] Operator varied(const Operator& person, base::Seed seed, std::uint32_t index,
                              std::uint32_t of);

} // namespace hapnet::device
