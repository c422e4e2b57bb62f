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

/// The emulator and the peers that pages watch: their connections, their last known states, and
/// their frames, which the feed joins. It knows nothing of pages.
class Daemons {
public:
    using Json = nlohmann::ordered_json;
    struct Handlers {
        std::function<void()> on_news;        // the known state of a daemon has changed
        std::function<void(Event)> on_event;  // an event whose moment is not set
        std::function<void()> on_other_peers; // other peers: live figures are cleared
    };

    Daemons(boost::asio::io_context& io, Handlers handlers)
        : io_{io}, handlers_{std::move(handlers)}
    {}

    /// Watches the daemons at these sockets from now on, and no others; an empty path: none.
    /// Daemons with the names of earlier ones count as returned, as in the next session of a loop.
    void watch(const std::string& emulator, const std::vector<std::string>& peers);
    /// Watches a session in virtual time. The sockets of its peers are beside its own.
    void watch_lab(const std::string& socket);

    /// Call it for every frame.
    void tick(base::TimePoint now);

    [[nodiscard]] Feed& feed() { return feed_; }
    [[nodiscard]] const Feed& feed() const { return feed_; }
    /// True if the attached session plays in virtual time.
    [[nodiscard]] bool is_virtual() const { return emulator_state_.is_virtual(); }
    [[nodiscard]] const EmulatorState& emulator_state() const { return emulator_state_; }
    [[nodiscard]] std::vector<PeerState> peer_states() const;

    /// Returns the emulator; null: it is not attached.
    [[nodiscard]] Daemon* emulator() const;
    /// Returns the attached peers.
    [[nodiscard]] std::vector<Daemon*> peers() const;
    /// Returns the attached peer whose hand pages may move; null: none.
    [[nodiscard]] Daemon* peer_with_hand() const;
    /// Returns the id of the peer whose hand pages may move; nullopt: no peer.
    [[nodiscard]] std::optional<std::uint16_t> hand_id() const;

    /// Notes the pace that the emulator has reported, in virtual time.
    void know_pace(Json pace) { emulator_state_.shown["pace"] = std::move(pace); }
    /// Notes a generation that a page's request has made, so that it is not reported again.
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
    [[nodiscard]] const Peer* with_hand() const; // null: pages may move no peer's hand
    [[nodiscard]] std::string name_of(std::size_t place) const
    {
        return name_of_peer(peer_states(), place);
    }

    boost::asio::io_context& io_;
    Handlers handlers_;
    Feed feed_;
    std::unique_ptr<Daemon> emulator_;
    EmulatorState emulator_state_;
    std::uint64_t own_generation_ = 0; // newest generation that a page's request has made
    std::uint64_t shown_generation_ = 0;
    bool is_showing_ = false;
    bool finds_lab_peers_ = false;             // peers are added once the lab tells how many
    std::vector<std::shared_ptr<Peer>> peers_; // in the order of the feed
    std::optional<base::TimePoint> next_look_; // next time to request the daemons' state
};

} // namespace hapnet::web
