// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/formats.hpp"
#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>
#include <variant>

namespace hapnet::emulator {

/// Loses `lost` datagrams in a row of every `of`; 0 < lost <= of. A burst begins at the numbers n
/// with n mod of = phase (< of), or at a phase that one draw at the start determines.
struct Burst {
    std::uint32_t lost = 0;
    std::uint32_t of = 0;
    std::optional<std::uint32_t> phase{};

    static constexpr DropCause cause = DropCause::burst_loss;
    static constexpr bool is_in_time = false;
    class Model;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const Burst&, const Burst&) = default;
};

constexpr auto fields_of(base::Tag<Burst>)
{
    return base::fields(
        "burst", base::field("lost", &Burst::lost, "datagrams lost in a row").required(),
        base::field("of", &Burst::of, "datagrams from the start of one burst to that of the next")
            .required(),
        base::field("phase", &Burst::phase, "number at which a burst begins; drawn if not given"));
}

class Burst::Model {
public:
    Model(const Burst& law, const base::RandomStream& stream) { change(law, stream); }

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream&) const
    {
        return (packet.number + shift_) % law_.of < law_.lost;
    }
    void change(const Burst& law, const base::RandomStream& stream);

private:
    Burst law_;
    std::uint64_t shift_ = 0; // position of datagram 0 in its period
};

/// One burst of losses in every period of time: all datagrams that arrive within `lost` of its
/// beginning, or the first `lost` datagrams after it. A burst begins at the times t with t mod
/// every = phase (< every), or at a phase that one draw at the start determines.
struct TimedBurst {
    std::variant<base::Duration, std::uint32_t> lost{};
    base::Duration every{};
    std::optional<base::Duration> phase{};

    static constexpr DropCause cause = DropCause::burst_loss;
    static constexpr bool is_in_time = true;
    class Model;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const TimedBurst&, const TimedBurst&) = default;
};

constexpr auto fields_of(base::Tag<TimedBurst>)
{
    return base::fields(
        "timed-burst",
        base::field("lost", &TimedBurst::lost, TimeOrCount{}, "length of a burst").required(),
        base::field("every", &TimedBurst::every,
                    "time from the start of one burst to that of the next")
            .required(),
        base::field("phase", &TimedBurst::phase,
                    "time at which a burst begins; drawn if not given"));
}

/// The run begins in the middle of a period. If the burst is a time, the run meets the rest of it;
/// if it is a number of datagrams, that period loses none. A law that begins later in the run drops
/// the first datagrams that it is shown.
class TimedBurst::Model {
public:
    Model(const TimedBurst& law, const base::RandomStream& stream) { change(law, stream); }

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream&);
    void change(const TimedBurst& law, const base::RandomStream& stream);

private:
    TimedBurst law_;
    base::Duration begin_{};   // beginning of period 0, in [0, every)
    std::int64_t period_ = -1; // period of the last datagram; -1: before begin_
    std::uint32_t lost_ = 0;   // losses so far in period_
};

} // namespace hapnet::emulator
