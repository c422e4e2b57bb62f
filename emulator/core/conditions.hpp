// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/delay.hpp"
#include "emulator/core/fate.hpp"
#include "emulator/core/formats.hpp"
#include "emulator/core/loss/loss.hpp"
#include "emulator/core/queue/control.hpp"
#include "emulator/core/trace/rate_trace.hpp"
#include "proto/base/probability.hpp"
#include "proto/base/result.hpp"
#include "proto/base/shared_vector.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hapnet::emulator {

/// Up: from A to B. Down: from B to A.
enum class Direction : std::uint8_t { up, down };
constexpr auto names_of(base::Tag<Direction>) { return base::names("up", "down"); }
[[nodiscard]] constexpr std::string_view to_text(Direction direction)
{
    return base::name_of(direction);
}

/// The order of departure of datagrams that jitter would let overtake each other.
enum class Order : std::uint8_t {
    keep,   // no datagram leaves before an earlier arrival; wide jitter lengthens the mean delay
    free,   // each datagram leaves at its own time; wide jitter reorders
    sorted, // the times are drawn as for free, and the datagrams take them in order of arrival
};
constexpr auto names_of(base::Tag<Order>) { return base::names("keep", "free", "sorted"); }
[[nodiscard]] constexpr std::string_view to_text(Order order) { return base::name_of(order); }

/// A second copy of a share of the datagrams, up to `spread` after the original (uniform). A copy
/// is not lost, copied or corrupted on its own.
struct Duplication {
    base::Probability share{};
    base::Duration spread{};

    friend bool operator==(const Duplication&, const Duplication&) = default;
};
constexpr auto fields_of(base::Tag<Duplication>)
{
    return base::fields(
        "duplicate",
        base::field("share", &Duplication::share, "share of the datagrams that is sent twice")
            .required(),
        base::field("spread", &Duplication::spread, "longest time from the original to its copy"));
}

/// A share of the datagrams leaves later than its turn, whatever the order policy is.
struct Reordering {
    base::Probability share{};
    Displacement displacement{};

    friend bool operator==(const Reordering&, const Reordering&) = default;
};
constexpr auto fields_of(base::Tag<Reordering>)
{
    return base::fields(
        "reorder",
        base::field("share", &Reordering::share,
                    "share of the datagrams that is held back, so that later ones overtake")
            .required(),
        base::field("displacement", &Reordering::displacement, DisplacementFormat{},
                    "number of later datagrams that overtake it, or the time by which it is late")
            .required());
}

/// In a share of the datagrams, `bits` bits are inverted; 1 <= bits <= Flips::most.
struct Corruption {
    base::Probability share{};
    std::uint8_t bits = 1;

    friend bool operator==(const Corruption&, const Corruption&) = default;
};
constexpr auto fields_of(base::Tag<Corruption>)
{
    return base::fields(
        "corrupt",
        base::field("share", &Corruption::share, "share of the datagrams with inverted bits")
            .required(),
        base::field("bits", &Corruption::bits, base::Count{1, Flips::most},
                    "inverted in each of them"));
}

/// Datagrams that, with their IP and UDP headers, are larger than `bytes_max` are dropped; 0: no
/// limit.
struct Mtu {
    static constexpr std::size_t header_bytes = 28; // IPv4 and UDP

    std::size_t bytes_max = 0;

    friend bool operator==(const Mtu&, const Mtu&) = default;
};
constexpr auto fields_of(base::Tag<Mtu>)
{
    return base::fields(
        "mtu", base::field("limit", &Mtu::bytes_max, base::Size{},
                           "largest datagram that passes, with its IP and UDP headers; 0: no limit")
                   .required());
}

/// A bottleneck that sends at a rate in bits a second, one datagram after the other, from a queue
/// that drops datagrams for which it has no room (QueueControl may drop more). 0 bits and no trace:
/// no bottleneck. With a burst it is a token bucket: the amount that the line could have sent while
/// it was idle, up to `burst_bytes`, leaves at once.
struct Rate {
    static constexpr std::size_t burst_bytes_most = std::size_t{1} << 30;

    std::uint64_t bits_per_second = 0;
    std::size_t overhead_bytes = 28;        // added to each payload; 28: IPv4 and UDP
    std::size_t queue_bytes_max = 64 << 10; // with overhead; without the datagram being sent
    std::optional<RateTraceLaw> trace{};    // instead of bits_per_second
    std::size_t burst_bytes = 0; // size of the token bucket, with overhead; it begins full

    [[nodiscard]] bool is_on() const { return bits_per_second > 0 || trace.has_value(); }

    friend bool operator==(const Rate&, const Rate&) = default;
};
/// Describes the fields without the trace, which is a law with keys of its own.
constexpr auto fields_of(base::Tag<Rate>)
{
    return base::fields(
        "rate",
        base::field("limit", &Rate::bits_per_second, base::BitRate{},
                    "bit rate of the bottleneck; 0: no bottleneck")
            .required(),
        base::field("overhead", &Rate::overhead_bytes, base::Size{},
                    "added to each payload for the headers"),
        base::field("queue", &Rate::queue_bytes_max, base::Size{},
                    "waiting room before the bottleneck; a datagram that does not fit is dropped"),
        base::field("burst", &Rate::burst_bytes, base::Size{},
                    "depth of a token bucket: bytes that leave at once after a pause; 0: none"));
}

// These functions refuse a stage whose parameters are impossible. The error says what would be
// right.

[[nodiscard]] base::Result<void> validate(const Mtu& mtu);
[[nodiscard]] base::Result<void> validate(const Rate& rate);
[[nodiscard]] base::Result<void> validate(const Corruption& corruption);
[[nodiscard]] base::Result<void> validate(const Duplication& duplication);
[[nodiscard]] base::Result<void> validate(const Reordering& reordering);

struct Regime;

/// The states between which a link changes by itself: two to four, or none.
struct Regimes {
    base::SharedVector<Regime> all{};
    bool are_together = false; // both directions always have the same regime

    [[nodiscard]] bool empty() const;

    friend bool operator==(const Regimes& a, const Regimes& b);
};

/// The conditions of one direction. The defaults change nothing.
struct Conditions {
    Mtu mtu{};
    Rate rate{};
    QueueControl queue{};
    std::vector<LossLaw> loss{}; // at most loss_laws_max; a datagram that any law drops is lost
    Corruption corrupt{};
    Duplication duplicate{};
    Variation delay{};
    Variation jitter{};
    Order order = Order::keep;
    Reordering reorder{};
    Regimes regimes{};

    friend bool operator==(const Conditions&, const Conditions&) = default;
};

/// The settings that a change sets. All other settings stay as they are.
struct Patch {
    std::optional<Mtu> mtu{};
    std::optional<Rate> rate{};
    std::optional<QueueControl> queue{};
    std::optional<std::vector<LossLaw>> loss{};
    std::optional<Corruption> corrupt{};
    std::optional<Duplication> duplicate{};
    std::optional<Variation> delay{};
    std::optional<Variation> jitter{};
    std::optional<Order> order{};
    std::optional<Reordering> reorder{};
    std::optional<Regimes> regimes{};

    friend bool operator==(const Patch&, const Patch&) = default;
};

/// The name of a regime: 1 to 32 characters of a-z, 0-9 and -.
struct RegimeNameFormat {
    void read(const base::Node& node, std::string& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::string& value) const { return base::quoted(value); }
    [[nodiscard]] std::string describe() const { return "a name of a-z, 0-9 and -"; }
};

/// Weights of regimes by their names, each finite and not negative.
using Weights = std::vector<std::pair<std::string, double>>;

/// Notation: { bad = 1, gone = 0.5 }
struct WeightsFormat {
    void read(const base::Node& node, Weights& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const Weights& value) const;
    [[nodiscard]] std::string describe() const { return "a table of weights, such as { bad = 1 }"; }
};

/// One of the states of a link: how long it lasts on average, the states that may follow it, and
/// its settings of delay, jitter, loss, rate, order, corrupt and duplicate. For a setting that the
/// regime does not have, that of the direction is in effect.
struct Regime {
    std::string name;
    base::Duration stay{};
    Weights to{};
    Patch own{};

    friend bool operator==(const Regime&, const Regime&) = default;
};
/// Describes the fields without the conditions, which have the keys of a direction.
constexpr auto fields_of(base::Tag<Regime>)
{
    return base::fields(
        "regime",
        base::field("name", &Regime::name, RegimeNameFormat{}, "its name in keys and statistics")
            .required(),
        base::field("stay", &Regime::stay,
                    "how long it lasts on average (exponential law), 1ms to 720h")
            .required(),
        base::field("to", &Regime::to, WeightsFormat{},
                    "weights of the regimes that may follow; without it all others weigh the "
                    "same"));
}

inline constexpr std::size_t regimes_max = 4;

/// The keys of a direction that a regime may have.
inline constexpr std::array<std::string_view, 7> regime_keys{
    "rate", "loss", "corrupt", "duplicate", "delay", "jitter", "order"};

/// Checks the number, names, stays and weights of the regimes, and that each regime recurs.
[[nodiscard]] base::Result<void> validate(const Regimes& regimes);

/// True if the regimes are equal in everything but their conditions: names, stays, weights, and
/// are_together.
[[nodiscard]] bool have_same_course(const Regimes& a, const Regimes& b);

/// Returns the names of the regimes, in their order.
[[nodiscard]] std::vector<std::string> regime_names(const Regimes& regimes);

/// A setting of a direction: its key, and the member that holds it.
template <typename T>
struct SettingSlot {
    std::string_view key;
    T Conditions::*value;
    std::optional<T> Patch::*patch;
};

/// Calls visit(slot) for each setting, in the order of the stages.
template <typename Visit>
constexpr void for_each_setting(const Visit& visit)
{
    const auto slot = [&]<typename T>(std::string_view key, T Conditions::*value,
                                      std::optional<T> Patch::*patch) {
        visit(SettingSlot<T>{key, value, patch});
    };
    slot("mtu", &Conditions::mtu, &Patch::mtu);
    slot("rate", &Conditions::rate, &Patch::rate);
    slot("queue", &Conditions::queue, &Patch::queue);
    slot("loss", &Conditions::loss, &Patch::loss);
    slot("corrupt", &Conditions::corrupt, &Patch::corrupt);
    slot("duplicate", &Conditions::duplicate, &Patch::duplicate);
    slot("delay", &Conditions::delay, &Patch::delay);
    slot("jitter", &Conditions::jitter, &Patch::jitter);
    slot("order", &Conditions::order, &Patch::order);
    slot("reorder", &Conditions::reorder, &Patch::reorder);
    slot("regime", &Conditions::regimes, &Patch::regimes);
}

/// Returns the settings of `a` and `b`. If both set a value, that of `b` wins.
[[nodiscard]] Patch merged(Patch a, const Patch& b);

/// Returns the settings of `conditions` that differ from the default.
[[nodiscard]] Patch to_patch(const Conditions& conditions);

/// Returns the conditions with the settings of `patch`.
[[nodiscard]] Conditions patched(Conditions conditions, const Patch& patch);

/// Returns the conditions in the regime at `index`, which must exist. The result has no regimes
/// itself.
[[nodiscard]] Conditions in_regime(const Conditions& conditions, std::size_t index);

/// Both directions of a path.
struct Path {
    Conditions up;
    Conditions down;

    friend bool operator==(const Path&, const Path&) = default;
};

} // namespace hapnet::emulator
