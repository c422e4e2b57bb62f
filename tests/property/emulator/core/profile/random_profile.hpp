// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/profile.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hapnet::emulator {

/// Draws profiles from the whole space of valid profiles.
class RandomProfile {
public:
    explicit RandomProfile(std::uint64_t seed) : stream_{base::Seed{seed}.stream("profiles")} {}

    Profile profile()
    {
        Profile drawn;
        constexpr std::array<const char*, 4> names{"", "x", "a \"quoted\" \\ name\n\t\x7f",
                                                   "\xc3\xa4#="};
        drawn.name = names[below(names.size())];
        if (below(2) == 0) drawn.seed = base::Seed{below(2) == 0 ? bits() : below(1000)};
        drawn.path = {conditions(), below(2) == 0 ? conditions() : Conditions{}};
        if (below(3) == 0) drawn.path.down = drawn.path.up;
        base::Duration time{};
        for (auto changes = below(4); changes > 0; --changes) {
            time += below(3) == 0 ? base::Duration{} : duration(1e12);
            Change change{time, {}, patch(), below(2) == 0 ? patch() : Patch{}};
            if (below(3) == 0) change.down = change.up;
            if (below(3) == 0) change.paths = paths();
            drawn.timeline.push_back(change);
        }
        if (below(3) == 0) drawn.paths = paths();
        if (below(3) == 0) add_flows(drawn);
        if (below(3) == 0) drawn.path.up.regimes = regimes();
        if (below(6) == 0) {
            drawn.path.up.regimes = drawn.path.down.regimes = regimes();
            drawn.path.up.regimes.are_together = drawn.path.down.regimes.are_together = true;
        }
        return drawn;
    }

private:
    /// Paths in ascending order of their names, each with at least one setting.
    std::vector<PathPatch> paths()
    {
        std::vector<PathPatch> drawn;
        for (const char* const name : {"1-12", "client.3", "wan"}) {
            PathPatch one{name, patch(), patch()};
            const bool has_something = one.up != Patch{} || one.down != Patch{};
            if (below(2) == 0 && has_something) drawn.push_back(std::move(one));
        }
        return drawn;
    }
    /// Flows with and without conditions, on all paths and on one of them.
    void add_flows(Profile& drawn)
    {
        for (const char* const name : {"a", "voice-2"}) {
            if (below(3) == 0) continue;
            Flow flow{.name = name, .match = possible<Match>()};
            PathPatch own{flow_path("", name), patch(), patch()};
            flow.passes = below(4) == 0;
            flow.shares_rate = !flow.passes && below(3) == 0;
            for (Patch* one : {&own.up, &own.down}) {
                if (flow.passes) *one = {};
                if (flow.shares_rate) one->rate.reset(), one->queue.reset();
            }
            drawn.flows.push_back(flow);
            if (own.up == Patch{} && own.down == Patch{}) continue;
            drawn.paths.push_back(own);
            for (const char* const path : {"1-12", "client.3", "wan"}) {
                own.path = flow_path(path, name);
                if (below(3) == 0) drawn.paths.push_back(own);
            }
            own.path = flow_path("", name);
            for (Change& change : drawn.timeline) {
                if (below(2) == 0) patch_for(change.paths, own.path) = own;
            }
        }
        std::ranges::sort(drawn.paths, {}, &PathPatch::path);
    }
    std::uint64_t bits() { return stream_.bits(index_++); }
    std::uint64_t below(std::uint64_t most) { return bits() % most; }
    double uniform() { return stream_.uniform(index_++); }

    base::Duration duration(double most)
    {
        const double value = std::pow(most, uniform());
        const auto unit = std::array{1.0, 1e3, 1e6}[below(3)];
        return base::Duration{static_cast<base::Duration::rep>(std::ceil(value / unit) * unit)};
    }

    base::Probability share()
    {
        const double value = below(3) == 0 ? std::round(uniform() * 100) / 100 : uniform();
        return base::Probability::from_fraction(value).value();
    }

    void draw(base::Duration& value)
    {
        value = below(8) == 0 ? base::Duration{} : duration(1e14);
        if (below(8) == 0) value = -value;
    }
    void draw(base::Probability& value) { value = share(); }
    void draw(double& value) { value = 1.0 + std::pow(1e6, uniform()); }
    void draw(std::uint8_t& value) { value = static_cast<std::uint8_t>(1 + below(8)); }
    void draw(std::uint32_t& value)
    {
        value = static_cast<std::uint32_t>(bits() >> (32 + below(32)));
    }
    void draw(std::uint16_t& value) { value = static_cast<std::uint16_t>(below(257)); }
    void draw(NumberRange& value)
    {
        value.first = static_cast<std::uint16_t>(below(2) == 0 ? 0 : below(1000));
        value.last = static_cast<std::uint16_t>(below(2) == 0 ? 65'535 : value.first + below(9));
    }
    void draw(Net& value)
    {
        constexpr std::array texts{"10.0.0.1", "192.168.0.0/16", "::1", "2001:db8::/32"};
        value = Net::parse(texts[below(texts.size())]).value();
    }
    void draw(std::uint64_t& value) { value = bits() >> (30 + below(34)); }
    void draw(QueueLaw& value)
    {
        value = std::array{QueueLaw::drop_tail, QueueLaw::codel, QueueLaw::pie,
                           QueueLaw::fq_codel}[below(4)];
    }
    void draw(bool& value) { value = below(2) == 0; }
    void draw(std::string& value) { value = "file"; }
    void draw(std::variant<base::Duration, std::uint32_t>& value)
    {
        value = static_cast<std::uint32_t>(1 + below(100));
        if (below(2) == 0) value = duration(1e9);
    }
    void draw(Displacement& value)
    {
        value = {static_cast<std::uint32_t>(1 + below(9)), {}};
        if (below(2) == 0) value = {0, duration(1e9)};
    }
    void draw(std::vector<std::uint64_t>& value)
    {
        std::uint64_t number = 0;
        for (auto n = below(5); n > 0; --n) value.push_back(number += 1 + below(1000));
    }
    void draw(std::vector<bool>& value)
    {
        for (auto n = 1 + below(9); n > 0; --n) value.push_back(below(2) == 0);
    }
    void draw(std::vector<Window>& value)
    {
        base::Duration time{};
        for (auto n = below(4); n > 0; --n) {
            const auto from = time + duration(1e12);
            time = from + duration(1e12);
            value.push_back({from, time});
        }
    }
    template <typename T>
    void draw(base::SharedVector<T>& value)
    {
        std::vector<T> elements;
        draw(elements);
        value = std::move(elements);
    }
    template <typename T>
    void draw(std::optional<T>& value)
    {
        if (below(2) == 0) draw(value.emplace());
    }

    template <typename T>
    T fields()
    {
        T drawn;
        base::for_each_field([&](const auto& /*field*/, auto& value) { draw(value); }, drawn);
        return drawn;
    }

    /// Draws a stage or law until it is valid.
    template <typename T, typename As = T>
    T possible()
    {
        for (;;) {
            T drawn = fields<T>();
            if constexpr (std::is_same_v<T, Match>) {
                if (drawn.ip) drawn.ip = static_cast<std::uint8_t>(4 + 2 * below(2));
                if (drawn.host) drawn.host = Net::parse("10.0.0.1").value();
            }
            if (validate(As{drawn})) return drawn;
        }
    }

    template <typename Law, typename... Laws>
    Law one_of()
    {
        Law law;
        std::uint64_t chosen = below(sizeof...(Laws));
        ((chosen-- == 0 ? void(law = fields<Laws>()) : void()), ...);
        return law;
    }

    Variation variation()
    {
        for (;;) {
            Variation drawn;
            drawn.law = one_of<DelayLaw, ConstantLaw, UniformLaw, NormalLaw, LogNormalLaw,
                               ExponentialLaw, ParetoLaw, GammaLaw>();
            if (below(2) == 0) draw(drawn.correlation_time);
            if (validate(drawn)) return drawn;
        }
    }

    std::vector<LossLaw> losses()
    {
        std::vector<LossLaw> laws;
        for (auto n = std::array<std::uint64_t, 5>{0, 1, 1, 3, 8}[below(5)]; laws.size() < n;) {
            auto law = one_of<LossLaw, RandomLoss, BlockLoss, PeriodicLoss, Burst, TimedBurst,
                              Gilbert, GilbertElliott, TimedGilbertElliott, FourState, ListedLoss,
                              PatternLoss, Outage>();
            if (validate(law)) laws.push_back(std::move(law));
        }
        return laws;
    }

    Patch patch()
    {
        Patch drawn;
        if (below(3) == 0) drawn.mtu = below(2) == 0 ? Mtu{} : possible<Mtu>();
        if (below(3) == 0) drawn.rate = below(2) == 0 ? Rate{} : possible<Rate>();
        if (below(3) == 0) drawn.loss = losses();
        if (below(3) == 0) drawn.corrupt = possible<Corruption>();
        if (below(3) == 0) drawn.duplicate = possible<Duplication>();
        if (below(3) == 0) drawn.delay = below(4) == 0 ? Variation{} : variation();
        if (below(3) == 0) drawn.jitter = below(4) == 0 ? Variation{} : variation();
        if (below(3) == 0)
            drawn.order = std::array{Order::keep, Order::free, Order::sorted}[below(3)];
        if (below(3) == 0) drawn.reorder = below(2) == 0 ? Reordering{} : possible<Reordering>();
        if (below(3) == 0) drawn.queue = below(2) == 0 ? QueueControl{} : possible<QueueControl>();
        return drawn;
    }

    /// Two or three regimes, whose names do not change.
    Regimes regimes()
    {
        std::vector<Regime> all;
        for (const char* const name : {"good", "bad"}) {
            Regime regime{name, std::chrono::milliseconds{1 + below(100'000)}, {}, patch()};
            regime.own.mtu.reset();
            regime.own.queue.reset();
            regime.own.reorder.reset();
            all.push_back(std::move(regime));
        }
        if (below(2) == 0) all.front().to = {{"bad", 1.0 + uniform()}};
        return {std::move(all)};
    }

    Conditions conditions() { return patched({}, patch()); }

    base::RandomStream stream_;
    std::uint64_t index_ = 0;
};

} // namespace hapnet::emulator
