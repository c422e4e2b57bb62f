// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/probability.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace hapnet::emulator {

class LossTrace;

// The laws of loss, as a person states them. A law that advances by datagrams counts every
// datagram of its direction, whatever other laws do to them.

/// Each datagram on its own, with one probability.
struct RandomLoss {
    base::Probability share{};

    friend bool operator==(const RandomLoss&, const RandomLoss&) = default;
};

/// Exactly `lost` of every `of` in a row, at random places in each such block. Blocks follow each
/// other from the first datagram under this law. 0 < lost <= of.
struct BlockLoss {
    std::uint32_t lost = 0;
    std::uint32_t of = 0;

    friend bool operator==(const BlockLoss&, const BlockLoss&) = default;
};

/// Every n-th: the numbers n with n mod every = phase. every > 0, phase < every.
struct PeriodicLoss {
    std::uint32_t every = 1;
    std::uint32_t phase = 0;

    friend bool operator==(const PeriodicLoss&, const PeriodicLoss&) = default;
};

/// `lost` in a row of every `of`; 0 < lost <= of. It begins at the numbers n with n mod of = phase
/// (< of), or where a draw at the beginning says.
struct Burst {
    std::uint32_t lost = 0;
    std::uint32_t of = 0;
    std::optional<std::uint32_t> phase{};

    friend bool operator==(const Burst&, const Burst&) = default;
};

/// A burst in every period of time: what arrives within `lost` of its beginning, or the first
/// `lost` datagrams after it. It begins at the times t with t mod every = phase (< every), or where
/// a draw at the beginning says.
struct TimedBurst {
    std::variant<base::Duration, std::uint32_t> lost{};
    base::Duration every{};
    std::optional<base::Duration> phase{};

    friend bool operator==(const TimedBurst&, const TimedBurst&) = default;
};

/// Gilbert's model by what one can measure: the share that is lost, and the mean length of a run of
/// losses in datagrams (>= 1 and > share / (1 - share)).
struct Gilbert {
    base::Probability share{};
    double mean_burst = 1.0;

    friend bool operator==(const Gilbert&, const Gilbert&) = default;
};

/// A chain of two states that takes one step per datagram (Gilbert 1960, Elliott 1963); a datagram
/// is judged in the state before the step, as tc-netem does it.
struct GilbertElliott {
    base::Probability good_to_bad{};
    base::Probability bad_to_good{};
    base::Probability loss_good{};
    base::Probability loss_bad{};

    friend bool operator==(const GilbertElliott&, const GilbertElliott&) = default;
};

/// The same chain in time instead of in datagrams: it stays good and bad for exponential times of
/// these means (> 0), however fast datagrams come.
struct TimedGilbertElliott {
    base::Duration mean_good{};
    base::Duration mean_bad{};
    base::Probability loss_good{};
    base::Probability loss_bad{};

    friend bool operator==(const TimedGilbertElliott&, const TimedGilbertElliott&) = default;
};

/// The four-state Markov model in its intuitive form (Salsano, Ludovici, Ordine, Giannuzzi,
/// "Definition of a general and intuitive loss model for packet networks", 2012): the whole share
/// that is lost; bursts of a mean length in datagrams, within which `density` is lost and the rest
/// comes in good runs of mean length `good_run` (>= 1); and the share of isolated losses outside
/// of bursts. isolated < share < density.
struct FourState {
    base::Probability share{};
    double burst = 1.0;
    base::Probability density{};
    base::Probability isolated{};
    double good_run = 2.0;

    friend bool operator==(const FourState&, const FourState&) = default;
};

/// The datagrams of these numbers, ascending.
struct ListedLoss {
    std::vector<std::uint64_t> numbers;

    friend bool operator==(const ListedLoss&, const ListedLoss&) = default;
};

/// A pattern that repeats: true is lost. Not empty.
struct PatternLoss {
    std::vector<bool> pattern;

    friend bool operator==(const PatternLoss&, const PatternLoss&) = default;
};

/// The losses of a recorded run; begins again at its end.
struct TraceLoss {
    std::string file;
    std::shared_ptr<const LossTrace> trace; // never null

    friend bool operator==(const TraceLoss&, const TraceLoss&);
};

/// A time during which everything is lost: from <= t < to, since the run began. from < to.
struct Window {
    base::Duration from{};
    base::Duration to{};

    friend bool operator==(const Window&, const Window&) = default;
};

/// Windows, ascending and apart from each other.
struct Outage {
    std::vector<Window> windows;

    friend bool operator==(const Outage&, const Outage&) = default;
};

using LossLaw =
    std::variant<RandomLoss, BlockLoss, PeriodicLoss, Burst, TimedBurst, Gilbert, GilbertElliott,
                 TimedGilbertElliott, FourState, ListedLoss, PatternLoss, TraceLoss, Outage>;

} // namespace hapnet::emulator
