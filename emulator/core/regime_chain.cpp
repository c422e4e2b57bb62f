// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/regime_chain.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace hapnet::emulator {

namespace {

// Draws of one index of the stream.
constexpr std::uint32_t draw_of_stay = 0;
constexpr std::uint32_t draw_of_follower = 1;

/// Returns the first index, among the shares above 0, at which the sum of the shares exceeds `u`.
std::size_t chosen(std::span<const double> shares, double u)
{
    std::size_t last = 0;
    for (std::size_t i = 0; i < shares.size(); ++i) {
        if (shares[i] <= 0.0) continue;
        last = i;
        if (u < shares[i]) break;
        u -= shares[i];
    }
    return last;
}

} // namespace

std::vector<double> followers_of(std::span<const Regime> regimes, std::size_t index)
{
    const Weights& to = regimes[index].to;
    std::vector<double> followers(regimes.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < regimes.size(); ++i) {
        if (i == index) continue;
        const auto own = std::ranges::find(to, regimes[i].name, &Weights::value_type::first);
        followers[i] = to.empty() ? 1.0 : own == to.end() ? 0.0 : own->second;
        sum += followers[i];
    }
    for (double& one : followers) one /= sum;
    return followers;
}

/// Computes the shares by the algorithm of Grassmann, Taksar and Heyman (Operations Research 33,
/// 1985), which has no subtractions.
std::vector<double> shares_of(std::span<const Regime> regimes)
{
    const std::size_t n = regimes.size();
    std::vector<std::vector<double>> rates;
    for (std::size_t i = 0; i < n; ++i) {
        rates.push_back(followers_of(regimes, i));
        for (double& one : rates.back()) one /= base::to_seconds(regimes[i].stay);
    }
    std::vector<double> shares(n, 1.0);
    std::vector<double> out(n);
    for (std::size_t k = n - 1; k > 0; --k) {
        for (std::size_t j = 0; j < k; ++j) out[k] += rates[k][j];
        for (std::size_t i = 0; i < k; ++i) {
            for (std::size_t j = 0; j < k; ++j) {
                if (i != j) rates[i][j] += rates[i][k] * rates[k][j] / out[k];
            }
        }
    }
    double sum = 1.0;
    for (std::size_t k = 1; k < n; ++k) {
        shares[k] = 0.0;
        for (std::size_t i = 0; i < k; ++i) shares[k] += shares[i] * rates[i][k] / out[k];
        sum += shares[k];
    }
    for (double& one : shares) one /= sum;
    return shares;
}

RegimeChain::RegimeChain(const Regimes& regimes, const base::RandomStream& stream)
    : stream_{stream}, past_(regimes.all.size())
{
    base::ensure(!regimes.empty());
    const std::span<const Regime> all{regimes.all.get()};
    for (std::size_t i = 0; i < all.size(); ++i) {
        states_.push_back({base::to_nanoseconds(all[i].stay), followers_of(all, i)});
    }
    now_ = chosen(shares_of(all), stream_.uniform(0, draw_of_follower));
    end_ = drawn_stay();
    past_[now_].stays = 1;
}

/// Draws the length of the stay that began last, by inversion of the exponential law.
base::Duration RegimeChain::drawn_stay() const
{
    const double u = stream_.uniform(stays_ - 1, draw_of_stay);
    const double stay = -states_[now_].stay_ns * base::log(1.0 - u);
    return base::Duration{std::max<base::Duration::rep>(static_cast<base::Duration::rep>(stay), 1)};
}

void RegimeChain::move_on()
{
    past_[now_].time += end_ - begin_;
    now_ = chosen(states_[now_].followers, stream_.uniform(stays_, draw_of_follower));
    ++stays_;
    ++past_[now_].stays;
    begin_ = end_;
    end_ += drawn_stay();
}

std::vector<RegimeCourse> RegimeChain::course(base::Duration until) const
{
    RegimeChain ahead = *this;
    std::ignore = ahead.at(until);
    auto all = std::move(ahead.past_);
    all[ahead.now_].time += std::max(until, begin_) - ahead.begin_;
    return all;
}

} // namespace hapnet::emulator
