// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "lab/records/session.hpp"
#include "peer/control/frame_tap.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/control/core/conversation.hpp"
#include "scene/description.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::lab::live {

/// A finished session from the records of its two peers. It plays as a Session does, at the
/// requested pace and from any moment, but nothing in it can be changed. Its times are those of the
/// records, each on the clock of its peer. It reads no clock.
class Recording {
public:
    /// Takes the last session that both records contain. The records may be in either order. Both
    /// outlive the result.
    [[nodiscard]] static base::Result<std::unique_ptr<Recording>> make(const record::Record& a,
                                                                       const record::Record& b);

    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;
    ~Recording() = default;

    static constexpr bool is_read_only = true;

    /// Returns the time since the first moment at which both records have a row.
    [[nodiscard]] base::Duration at() const { return at_; }
    /// Returns the time until one record has no further row, at most to the end of the session.
    [[nodiscard]] base::Duration length() const { return end_ - begin_; }
    [[nodiscard]] bool is_over() const { return at() >= length(); }
    [[nodiscard]] base::Duration tick() const { return tick_; }

    void play_to(base::Duration time);
    void play_on(base::Duration by) { play_to(at() + by); }
    void seek(base::Duration time);

    /// Answers like an emulator whose conditions are unknown and cannot be changed.
    [[nodiscard]] control::Answer answer(std::string_view line) const;
    [[nodiscard]] nlohmann::ordered_json statistics() const;
    [[nodiscard]] control::FrameSource watch();
    [[nodiscard]] control::FrameSource watch_peer(std::size_t seat)
    {
        return playbacks_[seat].tap.watch();
    }
    [[nodiscard]] nlohmann::ordered_json show_peer(std::size_t seat) const;
    /// Returns the position in the recording. The record does not hold the peer's other counters.
    [[nodiscard]] nlohmann::ordered_json peer_statistics(std::size_t seat) const;
    [[nodiscard]] std::size_t peers() const { return playbacks_.size(); }
    [[nodiscard]] const scene::Description& scene() const { return scene_; }

    [[nodiscard]] nlohmann::ordered_json steps() const { return nlohmann::ordered_json::array(); }
    [[nodiscard]] base::Result<experiment::Experiment> as_experiment() const;
    /// Returns 0: a recording computes nothing and has no digest.
    [[nodiscard]] std::uint64_t digest() const { return 0; }

private:
    /// A peer, and how far its rows have been shown.
    struct Playback {
        const record::Record* record = nullptr;
        records::Side side;
        records::Clock clock; // its clock, relative to that of side A
        std::uint16_t other = 0;
        peer::FrameTap tap;
        std::size_t ticks = 0;
        std::size_t messages = 0;
        std::size_t bodies = 0;
        std::size_t sessions = 0;
    };

    Recording(const records::Session& session, std::array<Playback, 2> playbacks);

    static void show_until(Playback& one, base::TimePoint until);
    static void show(Playback& one, const record::TickRow& tick);
    static void go_to(Playback& one, base::TimePoint time);

    std::array<Playback, 2> playbacks_; // in the order of the peers' ids
    scene::Description scene_;
    base::Duration tick_;
    base::TimePoint begin_; // time on the clock of side A
    base::TimePoint end_;
    base::Duration at_{};
    std::uint64_t frames_ = 0;
};

} // namespace hapnet::lab::live
