// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

#include <cstdint>

namespace hapnet::emulator {

/// Loses every n-th datagram: the numbers n with n mod every = phase. every > 0, phase < every.
struct PeriodicLoss {
    std::uint32_t every = 1;
    std::uint32_t phase = 0;

    static constexpr DropCause cause = DropCause::periodic_loss;
    static constexpr bool is_in_time = false;
    class Model;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const PeriodicLoss&, const PeriodicLoss&) = default;
};

constexpr auto fields_of(base::Tag<PeriodicLoss>)
{
    return base::fields(
        "every",
        base::field("every", &PeriodicLoss::every, "one datagram of this many is lost").required(),
        base::field("phase", &PeriodicLoss::phase, "number of the first that is lost"));
}

class PeriodicLoss::Model {
public:
    Model(const PeriodicLoss& law, const base::RandomStream& stream);

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream&) const
    {
        return packet.number % law_.every == law_.phase;
    }
    void change(const PeriodicLoss& law, const base::RandomStream&);

private:
    PeriodicLoss law_;
};

} // namespace hapnet::emulator
