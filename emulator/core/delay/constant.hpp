// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/bounds.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <string_view>

namespace hapnet::emulator {

/// A law with one constant value.
struct ConstantLaw {
    base::Duration value{};

    class Sampler;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LawMoments moments() const;

    friend bool operator==(const ConstantLaw&, const ConstantLaw&) = default;
};

constexpr auto fields_of(base::Tag<ConstantLaw>)
{
    return base::fields(
        "constant",
        base::field("value", &ConstantLaw::value, any_delay, "delay of every datagram").required());
}

class ConstantLaw::Sampler {
public:
    explicit Sampler(const ConstantLaw& law) : value_{law.value} {}

    [[nodiscard]] base::Duration at(const Packet&) const { return value_; }
    [[nodiscard]] base::Duration quantile(double) const { return value_; }

private:
    base::Duration value_;
};

} // namespace hapnet::emulator
