// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"
#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::peer {

/// The time at which a received state is given to the algorithm: at once, or through a buffer that
/// removes the jitter of the path.
enum class Playout : std::uint8_t { none, adaptive };
constexpr auto names_of(base::Tag<Playout> /*enum*/) { return base::names("none", "adaptive"); }

/// A buffer that plays states as evenly as they were sent. Each is played at its stamp plus a
/// transit time that all but 1 % of the last states did not exceed. The transit time grows at once
/// and shrinks by 1 % of the time, as in adaptive playout of speech (R. Ramjee et al., Adaptive
/// playout mechanisms for packetized audio applications in wide-area networks, INFOCOM 1994). Their
/// estimate is replaced by a quantile, as in S. B. Moon et al., Packet audio playout delay
/// adjustment, Multimedia Systems 6 (1998). It allocates no memory after its construction.
class PlayoutBuffer {
public:
    /// The share of states that may arrive after their playout time.
    static constexpr double late_share = 0.01;
    /// The largest number of states that determine the transit time. They were sent within
    /// `window_age`.
    static constexpr std::size_t window = 2000;
    static constexpr base::Duration window_age{std::chrono::seconds{10}};
    static constexpr base::Duration step{std::chrono::microseconds{100}}; // bin width of transits
    static constexpr std::size_t steps = 4096;
    /// A path counts as a new one if it becomes faster by more than `faster_max`. It also does if
    /// it becomes slower than all steps in most of the last states, of which there are at least
    /// `moved_after`.
    static constexpr base::Duration faster_max{std::chrono::milliseconds{100}};
    static constexpr std::size_t moved_after = 100;
    static constexpr double shrinks_by = 0.01; // decrease of the transit per time between stamps
    /// The longest wait of a state, and the largest number of states that wait.
    static constexpr base::Duration wait_max{std::chrono::milliseconds{200}};
    static constexpr std::size_t waiting_max = 256;

    PlayoutBuffer();

    /// Adds a state with its arrival time. Returns true if it arrived in time, within one step; the
    /// first one always does.
    bool put(const wire::State& state, base::TimePoint arrived);

    struct Played {
        wire::State state;
        base::TimePoint at; // due time, or arrival if that was later
    };
    /// Returns the next state that is due, in the order of the stamps; nullopt if there is none.
    [[nodiscard]] std::optional<Played> next(base::TimePoint now);

    /// Returns the time from a state's stamp, on the sender's clock, to its playout, on this peer's
    /// clock; nullopt before the first state.
    [[nodiscard]] std::optional<base::Duration> transit() const;

    /// Drops the waiting states and forgets the path.
    void forget();

private:
    struct Held {
        wire::State state;
        base::TimePoint arrived;
    };
    struct Seen {
        base::TimePoint sent;
        std::uint16_t bin = 0;
    };
    void observe(base::TimePoint sent, base::Duration transit);
    void count_in(const Seen& seen);
    void drop_oldest();
    void settle_quantile();
    [[nodiscard]] base::Duration quantile() const;
    [[nodiscard]] base::TimePoint due(const Held& held) const;

    std::vector<Held> held_;           // waiting_max places
    std::vector<std::uint16_t> free_;  // places of held_ that are free
    std::vector<std::uint16_t> order_; // places of held_ in use, by stamp
    std::vector<Seen> seen_;           // a ring of the last transits
    std::size_t oldest_ = 0;
    std::size_t count_ = 0;
    std::vector<std::uint16_t> bins_; // number of transits in seen_, by steps from origin_
    std::size_t quantile_ = 0;        // lowest bin that at most late_share of the transits exceed
    std::size_t above_ = 0;           // number of transits in bins above quantile_
    base::Duration origin_{};
    base::Duration transit_{};
    std::optional<base::TimePoint> last_sent_;
};

} // namespace hapnet::peer
