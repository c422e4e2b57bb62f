// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/burst.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

base::Result<void> Burst::validate() const
{
    if (lost == 0 || lost > of) {
        return base::fail(fmt::format(
            "cannot lose {} of {}: write at least 1 and at most all, as in 40/100", lost, of));
    }
    if (!phase || *phase < of) return {};
    return base::fail(fmt::format("phase {} is outside the period: write 0 to {}", *phase, of - 1));
}

LossTheory Burst::theory(const Arrivals& /*arrivals*/) const
{
    return theory_from_counts(of, lost, lost < of ? 1.0 : 0.0);
}

std::vector<LossProperty> Burst::properties(const RunFacts& /*facts*/) const
{
    return {RecurringBursts{lost, of, phase}};
}

void Burst::Model::change(const Burst& law, const base::RandomStream& stream)
{
    base::ensure(law.of > 0);
    law_ = law;
    shift_ = law.phase ? law.of - *law.phase : stream.below(law.of, 0);
}

base::Result<void> TimedBurst::validate() const
{
    constexpr base::Duration zero{0};
    if (every <= zero) return base::fail("the period of the bursts is 0: write a time above 0");
    if (const auto* time = std::get_if<base::Duration>(&lost)) {
        if (*time <= zero || *time > every) {
            return base::fail(
                fmt::format("a burst must last longer than 0 and at most its period of {}",
                            base::to_text(every)));
        }
    } else if (std::get<std::uint32_t>(lost) == 0) {
        return base::fail("a burst of 0 datagrams loses nothing: write 1 or more");
    }
    if (!phase || (*phase >= zero && *phase < every)) return {};
    return base::fail(
        fmt::format("the phase is outside the period: write less than {}", base::to_text(every)));
}

LossTheory TimedBurst::theory(const Arrivals& arrivals) const
{
    const auto spacing = static_cast<double>(arrivals.spacing.count());
    const double period = static_cast<double>(every.count()) / spacing; // period in datagrams
    const auto* time = std::get_if<base::Duration>(&lost);
    const double losses = time != nullptr ? static_cast<double>(time->count()) / spacing
                                          : static_cast<double>(std::get<std::uint32_t>(lost));
    if (losses >= period) return theory_from_counts(1.0, 1.0, 0.0);
    return theory_from_counts(period, losses, std::min(losses, 1.0));
}

std::vector<LossProperty> TimedBurst::properties(const RunFacts& /*facts*/) const
{
    return {Untestable{"losses depend on arrival times, which fates do not record"}};
}

bool TimedBurst::Model::on_packet(const Packet& packet, const base::RandomStream& /*stream*/)
{
    const bool is_before = packet.at < begin_;
    const base::Duration since = packet.at - begin_ + (is_before ? law_.every : base::Duration{0});
    if (const auto* time = std::get_if<base::Duration>(&law_.lost)) {
        return since % law_.every < *time;
    }
    const std::int64_t period = is_before ? -1 : since / law_.every;
    if (period != period_) {
        period_ = period;
        lost_ = 0;
    }
    const bool is_lost = !is_before && lost_ < std::get<std::uint32_t>(law_.lost);
    if (is_lost) ++lost_;
    return is_lost;
}

void TimedBurst::Model::change(const TimedBurst& law, const base::RandomStream& stream)
{
    base::ensure(law.every > base::Duration{0});
    law_ = law;
    const auto period = static_cast<double>(law.every.count());
    begin_ = law.phase.value_or(
        base::Duration{static_cast<base::Duration::rep>(stream.uniform(0) * period)});
}

} // namespace hapnet::emulator
