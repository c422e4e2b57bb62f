// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "web/core/frames.hpp"
#include "web/core/history.hpp"
#include "web/core/pairing.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::web {

/// The figures of a live frame, under the names that a trap's condition uses: "apart_mm",
/// "a.late_us.max". Unknown figures are left out.
using Figures = std::map<std::string, double, std::less<>>;

/// Joins the frames of all peers and of the emulator to live frames: docs/formats/live.md. It does
/// no I/O and reads no clock. Pass frames to the take_...() functions and call next() for the
/// result.
class Feed {
public:
    struct Source {
        std::uint16_t id = 0; // number of the peer
        std::string boot_id;  // peers with the same boot share one clock

        friend bool operator==(const Source&, const Source&) = default;
    };

    /// Sets the peers, in the order of their ids. If the list has changed, frames and history are
    /// cleared.
    void set_peers(std::vector<Source> peers);
    [[nodiscard]] const std::vector<Source>& peers() const { return peers_; }
    /// True if two peers use one clock: they report the same boot id, and the offset that the first
    /// peer has measured does not contradict it.
    [[nodiscard]] bool share_clock(std::size_t a, std::size_t b) const;

    /// Takes a frame of a peer. `place` is the peer's index in peers().
    void take_peer(std::size_t place, PeerFrame frame);
    void take_emulator(EmulatorFrame frame);
    /// Ends the frames of a peer. Live frames then have null in its place.
    void lose_peer(std::size_t place);
    void lose_emulator() { emulator_ = {}; }
    /// Empties the charts, for example when virtual time goes back.
    void forget();

    /// Returns the next live frame without its beginning, which differs from page to page:
    /// `,"at_s":...}`. nullopt: nothing is attached. Adds a row to the history.
    [[nodiscard]] std::optional<std::string> next(double at_s, base::TimePoint now);

    /// Returns the newest live frame again, marked as `repeated`, for a page that connects later.
    /// Adds no row.
    [[nodiscard]] std::optional<std::string> newest(double at_s, base::TimePoint now) const;

    /// Returns the figures of the newest live frame.
    [[nodiscard]] const Figures& figures() const { return figures_; }
    [[nodiscard]] const History& history() const { return history_; }
    [[nodiscard]] std::optional<std::uint64_t> generation() const;
    /// Returns the time since the emulator's start, by its newest frame. In virtual time this is
    /// the time of the session.
    [[nodiscard]] std::optional<double> elapsed_s() const;
    /// Returns a counter of the frames whose time differs from that of the frame before. Virtual
    /// time may stand still.
    [[nodiscard]] std::uint64_t moves() const { return moves_; }
    /// Returns the names of the emulator's paths. They remain known after the emulator has
    /// detached.
    [[nodiscard]] const std::vector<std::string>& paths() const { return known_paths_; }

    /// Returns all names that figures() may have with these peers and paths.
    [[nodiscard]] std::vector<std::string> names() const;

private:
    template <typename Frame>
    struct Newest {
        std::optional<Frame> frame;
        bool is_new = false; // arrived since the previous live frame
    };
    struct Pair {
        std::size_t a = 0;
        std::size_t b = 0;
        std::optional<Apart> apart;
        double force_apart_n = unknown;
        double uncertainty_ms = unknown;
    };

    [[nodiscard]] bool is_empty() const; // true if nothing is attached
    [[nodiscard]] std::string text_of(const std::vector<Pair>& pairs, double at_s,
                                      base::TimePoint now, bool is_again) const;
    [[nodiscard]] Pair pair_of(std::size_t a, std::size_t b) const;
    [[nodiscard]] const PeerFrame::Heard* heard_by(std::size_t place, std::uint16_t from) const;
    [[nodiscard]] std::vector<Pair> pairs() const;
    void note_figures(const std::vector<Pair>& pairs);
    void note_way(const std::string& name, const EmulatorFrame::Way& way);
    void note_history(double at_s, const std::vector<Pair>& pairs);

    std::vector<Source> peers_;
    std::vector<Newest<PeerFrame>> newest_; // one for each of peers_
    std::vector<Track> tracks_;             // one for each of peers_
    Newest<EmulatorFrame> emulator_;
    std::uint64_t moves_ = 0;
    std::vector<std::string> known_paths_; // kept while no emulator is attached
    Figures figures_;
    History history_;
};

} // namespace hapnet::web
