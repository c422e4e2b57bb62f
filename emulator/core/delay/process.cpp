// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/process.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"
#include "proto/base/normal.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::emulator {

namespace {

constexpr double u_min = 0x1p-54; // what stands for a drawn 0
constexpr double u_max = 1.0 - 0x1p-53;

} // namespace

DelayProcess::DelayProcess(const Variation& variation, const base::RandomStream& stream)
    : sampler_{ConstantSampler{}}, correlation_time_{}, stream_{stream}
{
    change(variation);
}

base::Duration DelayProcess::on_packet(const Packet& packet)
{
    if (trace_) return trace_->at(packet);
    if (const auto* constant = std::get_if<ConstantSampler>(&sampler_)) return constant->value;
    const double u = uniform(packet);
    return std::visit([u](auto& sampler) { return sampler.quantile(u); }, sampler_);
}

/// The uniform number of the datagram, strictly between 0 and 1.
double DelayProcess::uniform(const Packet& packet)
{
    const double u = std::max(stream_.uniform(packet.number), u_min);
    if (correlation_time_ == base::Duration{0}) return u;
    // Ornstein and Uhlenbeck's process, exact however far the datagrams lie apart.
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
    if (const auto* law = std::get_if<TraceLaw>(&variation.law)) {
        base::ensure(law->trace != nullptr);
        trace_ = law->trace;
        return;
    }
    trace_ = nullptr;
    adapt(sampler_, variation.law);
}

} // namespace hapnet::emulator
