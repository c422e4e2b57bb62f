// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/emulation.hpp"
#include "emulator/control/frames.hpp"
#include "lab/experiment/experiment.hpp"
#include "lab/live/reports.hpp"
#include "lab/virtual_time/journal.hpp"
#include "lab/virtual_time/world.hpp"
#include "peer/control/frame_tap.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/control/core/conversation.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::live {

/// A session in virtual time that is watched while it plays. It plays as far as the caller asks,
/// and its conditions change like those of a running emulator. It can go to any time, back or
/// forth: it is then played again from its seed, with all settings. Further algorithms play in
/// parallel, each in a session of its own, under the same network, datagram for datagram. It reads
/// no clock.
class Session {
public:
    static constexpr std::size_t algorithms_max = 3;
    static constexpr bool is_read_only = false;

    /// The source of the motion of A's hand.
    enum class HandOfA : std::uint8_t { simulated, page };

    /// Takes the first task and seed of the experiment, and up to three of its algorithms.
    /// `presets` returns the text of a built-in profile.
    using Presets = std::function<base::Result<std::string>(const std::string& name)>;
    [[nodiscard]] static base::Result<std::unique_ptr<Session>>
    make(const experiment::Experiment& experiment, Presets presets,
         HandOfA hand_of_a = HandOfA::simulated);

    ~Session() = default;
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Returns the time since the first hello.
    [[nodiscard]] base::Duration at() const { return world_->now() - World::start; }
    /// Returns the time from the first hello to the session's end. Until the session is agreed on,
    /// it is an estimate.
    [[nodiscard]] base::Duration length() const;
    [[nodiscard]] bool is_over() const { return at() >= length(); }

    /// Plays on to that time, at most to the end.
    void play_to(base::Duration time);
    /// Plays on for `by`, at most to the end. To play as fast as possible, call it again and again
    /// with steps of at least a tick.
    void play_on(base::Duration by) { play_to(at() + by); }
    /// Goes to a time at once, back or forth.
    void seek(base::Duration time);

    /// Answers a request to the emulator. Its changes apply from now on, in all sessions. Changes
    /// that are later in the session, made before a seek back to this time, are then forgotten.
    [[nodiscard]] control::Answer answer(std::string_view line);
    [[nodiscard]] nlohmann::ordered_json statistics() const;

    /// Sets the wish of the page that moves the hand from now on, in all sessions; nullopt releases
    /// the hand. The wish is part of the session like a change of the conditions.
    void hand(const std::optional<device::HandWish>& wish);
    /// True if a page moves A's hand.
    [[nodiscard]] bool has_page_hand() const
    {
        return settings_.front().players.front().page != nullptr;
    }

    /// Returns the source of frames: those of the emulator, with the distances of the copies under
    /// the other algorithms, and those of a peer of the first session.
    [[nodiscard]] control::FrameSource watch();
    [[nodiscard]] control::FrameSource watch_peer(std::size_t seat) { return taps_[seat].watch(); }
    /// Returns a peer's report on itself, in the form that a daemon gives it.
    [[nodiscard]] nlohmann::ordered_json show_peer(std::size_t seat) const;
    /// Returns the peer's counters, except those of sockets and a clock.
    [[nodiscard]] nlohmann::ordered_json peer_statistics(std::size_t seat) const;
    [[nodiscard]] std::size_t peers() const { return settings_.front().players.size(); }
    [[nodiscard]] const scene::Description& scene() const { return settings_.front().scene; }

    /// Returns the changes so far, each as {"at_s","settings"}.
    [[nodiscard]] nlohmann::ordered_json steps() const;
    /// Returns an experiment that plays the same, bit for bit. It has the changes as its timeline,
    /// and the motion of a page's hand so far as its replay, without a name yet. The error says why
    /// there is none.
    [[nodiscard]] base::Result<experiment::Experiment> as_experiment() const;

    /// Returns a digest of all forces on the hands and motions of the bodies in every session so
    /// far. Equal bits give equal digests.
    [[nodiscard]] std::uint64_t digest() const { return digest_; }

private:
    using World = virtual_time::VirtualWorld;
    struct Request {
        base::Duration at{};
        std::string line; // request to the emulator; empty: `hand` is for a page's hand
        std::optional<device::HandWish> hand{};

        [[nodiscard]] bool is_for_hand() const { return line.empty(); }
    };

    Session(const experiment::Experiment& experiment, std::vector<virtual_time::Setting> settings,
            Presets presets);

    void begin();
    void run_to(base::TimePoint end);
    void step();
    void note(const virtual_time::VirtualPlayer& player);
    void note_hand();
    void keep(Request request);
    void apply(const Request& request);
    [[nodiscard]] std::string apply(const std::string& line);
    void append_others(std::string& text) const;
    [[nodiscard]] PeerIntroduction introduce_peer(std::size_t seat) const;

    experiment::Experiment experiment_;
    std::vector<virtual_time::Setting> settings_; // one for each algorithm
    Presets presets_;
    std::unique_ptr<World> world_;
    std::vector<emulator::Emulation> emulations_; // one for the links of each session
    std::shared_ptr<emulator::Frames> frames_;    // frames of the first session's links
    std::uint64_t lives_ = 0;                     // number of times that the sessions have begun
    std::vector<virtual_time::Journal> journals_; // one for each player of the first session
    std::vector<peer::FrameTap> taps_;            // one for each player of the first session
    bool is_shown_ = true;          // false: viewers are not shown this part of a seek
    device::HandTrace hand_;        // motion of a page's hand since the session was agreed on
    std::vector<Request> requests_; // requests that changed something, by time
    std::size_t done_ = 0;          // number of `requests_` that have been applied
    std::uint64_t digest_ = 0;
};

} // namespace hapnet::lab::live
