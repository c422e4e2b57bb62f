// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

namespace hapnet::emulator {

/// Loses each datagram on its own, with one probability.
struct RandomLoss {
    base::Probability share{};

    static constexpr DropCause cause = DropCause::random_loss;
    static constexpr bool is_in_time = false;
    class Model;

    [[nodiscard]] base::Result<void> validate() const { return {}; }
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const RandomLoss&, const RandomLoss&) = default;
};

constexpr auto fields_of(base::Tag<RandomLoss>)
{
    return base::fields("random",
                        base::field("share", &RandomLoss::share,
                                    "share of the datagrams that is lost, each on its own")
                            .required());
}

class RandomLoss::Model {
public:
    Model(const RandomLoss& law, const base::RandomStream&) : law_{law} {}

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream& stream) const
    {
        return stream.uniform(packet.number) < law_.share.fraction();
    }
    void change(const RandomLoss& law, const base::RandomStream&) { law_ = law; }

private:
    RandomLoss law_;
};

} // namespace hapnet::emulator
