// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/delay.hpp"

#include "proto/base/math.hpp"
#include "proto/base/normal.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::emulator {

namespace {

constexpr double u_min = 0x1p-54; // replaces a drawn 0
constexpr double u_max = 1.0 - 0x1p-53;

} // namespace

DelaySampler make_sampler(const DelayLaw& law)
{
    return std::visit(
        []<typename Law>(const Law& stated) { return DelaySampler{typename Law::Sampler{stated}}; },
        law);
}

std::string_view name_of(const DelayLaw& law)
{
    return std::visit([]<typename Law>(const Law&) { return base::described_name<Law>; }, law);
}

base::Result<void> validate(const Variation& variation)
{
    constexpr base::Duration zero{0};
    const bool is_trace = std::holds_alternative<TraceLaw>(variation.law);
    return all(
        {std::visit([](const auto& law) { return law.validate(); }, variation.law),
         require(variation.correlation_time >= zero, "correlation_time must not be negative"),
         require(!is_trace || variation.correlation_time == zero,
                 "correlation_time is not for traces: they are correlated as recorded")});
}

bool is_nothing(const Variation& variation)
{
    return variation.law == DelayLaw{ConstantLaw{}} || variation.law == DelayLaw{UniformLaw{}};
}

DelayProcess::DelayProcess(const Variation& variation, const base::RandomStream& stream)
    : sampler_{make_sampler(variation.law)},
      correlation_time_{variation.correlation_time},
      stream_{stream}
{}

base::Duration DelayProcess::draw(const Packet& packet)
{
    return std::visit(
        [&](auto& sampler) {
            if constexpr (requires { sampler.at(packet); }) {
                return sampler.at(packet);
            } else {
                return sampler.quantile(uniform(packet));
            }
        },
        sampler_);
}

/// Returns the uniform number of the datagram, strictly between 0 and 1.
double DelayProcess::uniform(const Packet& packet)
{
    const double u = std::max(stream_.uniform(packet.number), u_min);
    if (correlation_time_ == base::Duration{0}) return u;
    // Ornstein and Uhlenbeck's process, exact for any distance of the datagrams.
    const double fresh = base::normal_quantile(u);
    if (!gaussian_) {
        gaussian_ = Gaussian{fresh, packet.at};
        return u;
    }
    const auto passed = std::max(packet.at - gaussian_->at, base::Duration{0});
    const double rho = base::exp(-static_cast<double>(passed.count()) /
                                 static_cast<double>(correlation_time_.count()));
    const double value = rho * gaussian_->value + std::sqrt((1.0 - rho) * (1.0 + rho)) * fresh;
    gaussian_ = Gaussian{value, packet.at};
    return std::clamp(base::normal_cdf(value), u_min, u_max);
}

void DelayProcess::change(const Variation& variation)
{
    correlation_time_ = variation.correlation_time;
    if (correlation_time_ == base::Duration{0}) gaussian_.reset();
    std::visit(
        [&]<typename Law>(const Law& law) {
            auto* sampler = std::get_if<typename Law::Sampler>(&sampler_);
            if constexpr (requires { sampler->change(law); }) {
                if (sampler != nullptr) return sampler->change(law);
            }
            sampler_.emplace<typename Law::Sampler>(law);
        },
        variation.law);
}

} // namespace hapnet::emulator
