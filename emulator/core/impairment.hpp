// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/verdict.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <variant>

namespace hapnet::emulator {

// The impairments: small copyable values with one verb, on_packet(). A verdict is a pure function
// of the impairment and the datagram's number; none of them keeps state between datagrams.

/// The same delay for every datagram; not negative.
class ConstantDelay {
public:
    explicit ConstantDelay(base::Duration delay);
    [[nodiscard]] Verdict on_packet(std::uint64_t number) const;

private:
    base::Duration delay_;
};

/// An offset drawn for each datagram on its own, uniform on [-half_width, +half_width]: its
/// standard deviation is half_width / sqrt(3). half_width is not negative.
class UniformJitter {
public:
    UniformJitter(base::Duration half_width, base::RandomStream stream);
    [[nodiscard]] Verdict on_packet(std::uint64_t number) const;

private:
    base::Duration half_width_;
    base::RandomStream stream_;
};

/// Drops each datagram on its own with one probability.
class RandomLoss {
public:
    RandomLoss(base::Probability probability, base::RandomStream stream);
    [[nodiscard]] Verdict on_packet(std::uint64_t number) const;

private:
    base::Probability probability_;
    base::RandomStream stream_;
};

/// `lost` datagrams in a row of every `of`; 0 < lost <= of.
struct Burst {
    std::uint32_t lost = 0;
    std::uint32_t of = 0;

    friend bool operator==(const Burst&, const Burst&) = default;
};

/// Drops exactly `burst.lost` consecutive datagrams of every `burst.of` consecutive ones. Where
/// in the period the burst lies is the stream's one draw, so that the two directions of a run,
/// whose streams differ, are not in step.
class BurstLoss {
public:
    BurstLoss(Burst burst, const base::RandomStream& stream);
    [[nodiscard]] Verdict on_packet(std::uint64_t number) const;

private:
    Burst burst_;
    std::uint64_t phase_;
};

using Impairment = std::variant<RandomLoss, BurstLoss, ConstantDelay, UniformJitter>;

} // namespace hapnet::emulator
