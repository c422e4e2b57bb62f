// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "web/core/events.hpp"
#include "web/core/feed.hpp"
#include "web/core/state.hpp"
#include "web/daemon.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::web {

/// The emulator and the peers that pages look at: their connections, what they say of themselves,
/// and their frames, which the feed joins. Knows nothing of pages.
class Daemons {
public:
    using Json = nlohmann::ordered_json;
    struct Handlers {
        std::function<void()> on_news;        // the known state of a daemon has changed
        std::function<void(Event)> on_event;  // an event whose moment is not set
        std::function<void()> on_other_peers; // other peers: live figures begin again
    };

    Daemons(boost::asio::io_context& io, Handlers handlers)
        : io_{io}, handlers_{std::move(handlers)}
    {}

    /// Watches the daemons of these sockets from now on, and no others; an empty path: none.
    /// Daemons with the names of earlier ones count as returned, as in the next session of a loop.
    void watch(const std::string& emulator, const std::vector<std::string>& peers);
    /// A session in virtual time, whose peers have their sockets beside it.
    void watch_lab(const std::string& socket);

    /// Call it every frame.
    void tick(base::TimePoint now);

    [[nodiscard]] Feed& feed() { return feed_; }
    [[nodiscard]] const Feed& feed() const { return feed_; }
    /// True if what is attached plays in virtual time.
    [[nodiscard]] bool is_virtual() const { return emulator_state_.is_virtual(); }
    [[nodiscard]] const EmulatorState& emulator_state() const { return emulator_state_; }
    [[nodiscard]] std::vector<PeerState> peer_states() const;

    /// null: it is not attached.
    [[nodiscard]] Daemon* emulator() const;
    /// The peers that are attached.
    [[nodiscard]] std::vector<Daemon*> peers() const;
    /// The attached peer whose hand pages may move; null: none.
    [[nodiscard]] Daemon* peer_with_hand() const;
    /// The id of the peer whose hand pages may move; nullopt: no peer.
    [[nodiscard]] std::optional<std::uint16_t> hand_id() const;

    /// The emulator has told its pace, in virtual time.
    void know_pace(Json pace) { emulator_state_.shown["pace"] = std::move(pace); }
    /// A request of a page has made this generation, so it is not reported again.
    void know_generation(std::uint64_t generation);

private:
    struct Peer {
        std::unique_ptr<Daemon> daemon;
        PeerState state;
        std::size_t place = 0; // index in the feed
    };

    void set_emulator(const std::string& path);
    void add_peer(const std::string& path);
    void on_emulator_frame(std::string_view line);
    void on_peer_frame(Peer& peer, std::string_view line);
    void ask_emulator_to_show();
    void ask_peer_to_show(const std::shared_ptr<Peer>& peer);
    void ask_for_scene(const std::shared_ptr<Peer>& peer);
    void order_peers();
    void note(const std::string& kind, const std::string& text);
    [[nodiscard]] const Peer* with_hand() const; // null: no peer has a hand
    [[nodiscard]] std::string name_of(std::size_t place) const
    {
        return name_of_peer(peer_states(), place);
    }

    boost::asio::io_context& io_;
    Handlers handlers_;
    Feed feed_;
    std::unique_ptr<Daemon> emulator_;
    EmulatorState emulator_state_;
    std::uint64_t own_generation_ = 0; // newest one that a page's request has made
    std::uint64_t shown_generation_ = 0;
    bool is_showing_ = false;
    bool finds_lab_peers_ = false;             // peers are added once the lab tells how many
    std::vector<std::shared_ptr<Peer>> peers_; // in the order of the feed
    std::optional<base::TimePoint> next_look_; // next time to ask the daemons for their state
};

} // namespace hapnet::web
