// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/constant.hpp"
#include "emulator/core/delay/exponential.hpp"
#include "emulator/core/delay/gamma.hpp"
#include "emulator/core/delay/log_normal.hpp"
#include "emulator/core/delay/normal.hpp"
#include "emulator/core/delay/pareto.hpp"
#include "emulator/core/delay/table.hpp"
#include "emulator/core/delay/trace.hpp"
#include "emulator/core/delay/uniform.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <concepts>
#include <optional>
#include <string_view>
#include <variant>

namespace hapnet::emulator {

// The laws that a delay or a jitter may follow. Each has a file of its own with its parameters, its
// sampler, its moments, and the check of its parameters. The parameters have specific names: no law
// has a bare "jitter". `mean` may be zero (a jitter around the delay) or negative for the symmetric
// laws only; widths and deviations are not negative.

/// A law, as a person states it.
using DelayLaw = std::variant<ConstantLaw, UniformLaw, NormalLaw, LogNormalLaw, ExponentialLaw,
                              ParetoLaw, GammaLaw, TableLaw, TraceLaw>;

/// A law prepared for drawing: everything that is the same for all draws is precomputed.
/// quantile(u) is the delay that a share u of all delays stays below, 0 < u < 1. A law that draws
/// nothing has at(packet) instead. Parameters just outside of their range, as the rounding of a
/// ramp makes them, count as the nearest possible ones.
template <typename Sampler, typename Law>
concept DelaySamplerOf = std::constructible_from<Sampler, const Law&> &&(
    requires(Sampler sampler) {
        requires std::same_as<decltype(sampler.quantile(0.5)), base::Duration>;
    } ||
    requires(Sampler sampler, const Packet& packet) {
        requires std::same_as<decltype(sampler.at(packet)), base::Duration>;
    });

/// Requirements that every law of delay meets. fields_of() gives its name in profiles, and its
/// parameters.
template <typename Law>
concept LawOfDelay = base::Described<Law> && std::equality_comparable<Law> &&
    DelaySamplerOf<typename Law::Sampler, Law> && requires(const Law& law)
{
    // in words that follow the name of the setting
    requires std::same_as<decltype(law.validate()), base::Result<void>>;
    requires std::same_as<decltype(law.moments()), LawMoments>;
};

template <typename Laws>
struct SamplersOf;
template <LawOfDelay... Laws>
struct SamplersOf<std::variant<Laws...>> {
    using type = std::variant<typename Laws::Sampler...>;
};
using DelaySampler = SamplersOf<DelayLaw>::type;

[[nodiscard]] DelaySampler make_sampler(const DelayLaw& law);

/// "uniform", "log-normal", ...: the name of a law in profiles.
[[nodiscard]] std::string_view name_of(const DelayLaw& law);

/// The variation of a delay, or of the jitter around it, from datagram to datagram.
struct Variation {
    DelayLaw law = ConstantLaw{};
    /// Draws that lie t apart in arrival time are correlated by exp(-t / correlation_time)
    /// (Gaussian copula: the law itself stays exact); zero: independent. Not for traces.
    base::Duration correlation_time{};

    friend bool operator==(const Variation&, const Variation&) = default;
};

[[nodiscard]] inline Variation constant(base::Duration value) { return {ConstantLaw{value}, {}}; }
/// Returns a uniform variation around zero.
[[nodiscard]] inline Variation uniform(base::Duration half_width)
{
    return {UniformLaw{{}, half_width}, {}};
}

/// Refuses a variation that cannot be drawn. The error follows the name of the setting: "sd must be
/// more than 0".
[[nodiscard]] base::Result<void> validate(const Variation& variation);

/// True if the variation adds nothing to any datagram.
[[nodiscard]] bool is_nothing(const Variation& variation);

/// Draws the delay, or the jitter, of one datagram after the other: the quantile of the law at the
/// uniform number of the datagram. Without correlation a delay depends only on the number of its
/// datagram. With correlation it also depends on the arrival times of the datagrams.
class DelayProcess {
public:
    /// `variation` is one that validate() accepts, except for rounding in a ramp.
    DelayProcess(const Variation& variation, const base::RandomStream& stream);

    /// Returns the delay of the next datagram. That of a jitter may be negative. Call it once for
    /// every datagram of the direction, in the order of their numbers. Does not allocate.
    [[nodiscard]] base::Duration on_packet(const Packet& packet)
    {
        const auto* constant = std::get_if<ConstantLaw::Sampler>(&sampler_); // the fast path
        return constant != nullptr ? constant->at(packet) : draw(packet);
    }

    /// Changes the law from the next datagram on. A correlated process continues from its state,
    /// whatever the new law is. Cheap, and does not allocate: a ramp changes the law every
    /// millisecond.
    void change(const Variation& variation);

private:
    /// A Gaussian process whose correlation decays as exp(-t / correlation_time).
    struct Gaussian {
        double value;
        base::Duration at;
    };

    [[nodiscard]] base::Duration draw(const Packet& packet);
    [[nodiscard]] double uniform(const Packet& packet);

    DelaySampler sampler_;
    base::Duration correlation_time_{};
    std::optional<Gaussian> gaussian_; // nullopt: nothing was drawn yet
    base::RandomStream stream_;
};

} // namespace hapnet::emulator
