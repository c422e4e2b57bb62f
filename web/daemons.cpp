// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/daemons.hpp"

#include "web/core/condition_words.hpp"
#include "web/core/members.hpp"
#include "web/core/stage_plan.hpp"

#include <algorithm>
#include <chrono>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::web {

namespace {

constexpr base::Duration look_every{std::chrono::milliseconds{500}};

const std::string show_request = R"({"command":"show"})";
const std::string scene_request = R"({"command":"scene"})";

} // namespace

void Daemons::watch(const std::string& emulator, const std::vector<std::string>& peers)
{
    set_emulator(emulator);
    const bool are_same =
        std::ranges::equal(peers, peers_, [](const std::string& path, const auto& peer) {
            return peer->daemon->path() == path;
        });
    if (!are_same) {
        peers_.clear();
        for (const std::string& path : peers) add_peer(path);
        order_peers();
    }
    handlers_.on_news();
}

void Daemons::watch_lab(const std::string& socket)
{
    finds_lab_peers_ = true;
    watch(socket, {});
}

void Daemons::tick(base::TimePoint now)
{
    if (emulator_) emulator_->tick(now);
    for (const auto& peer : peers_) peer->daemon->tick(now);
    if (next_look_ && !base::is_due(next_look_, now)) return;
    next_look_ = now + look_every;
    for (const auto& peer : peers_) {
        if (peer->daemon->is_attached()) ask_peer_to_show(peer);
    }
    if (is_virtual()) ask_emulator_to_show(); // the reply has the present virtual time
}

void Daemons::know_generation(std::uint64_t generation)
{
    own_generation_ = std::max(own_generation_, generation);
    ask_emulator_to_show();
}

void Daemons::note(const std::string& kind, const std::string& text)
{
    handlers_.on_event({.at = {}, .kind = kind, .text = text});
}

void Daemons::set_emulator(const std::string& path)
{
    if (emulator_ && emulator_->path() == path) return;
    emulator_.reset();
    emulator_state_ = {.socket = path};
    feed_.lose_emulator();
    if (path.empty()) return;
    emulator_ = std::make_unique<Daemon>(
        io_, path, "20ms",
        Daemon::Handlers{.on_attached =
                             [this] {
                                 emulator_state_.is_attached = true;
                                 emulator_state_.error.clear();
                                 shown_generation_ = 0;
                                 is_showing_ = false;
                                 note("emulator", "the emulator is attached");
                                 ask_emulator_to_show();
                             },
                         .on_frame = [this](std::string_view line) { on_emulator_frame(line); },
                         .on_lost =
                             [this](const std::string& why) {
                                 emulator_state_.is_attached = false;
                                 emulator_state_.error = why;
                                 feed_.lose_emulator();
                                 note("emulator", "the emulator is gone: " + why);
                             }});
}

void Daemons::add_peer(const std::string& path)
{
    auto peer = std::make_shared<Peer>();
    peer->state.socket = path;
    peer->place = peers_.size();
    const std::weak_ptr<Peer> weak = peer; // weak: the peer owns the daemon and so its handlers
    peer->daemon = std::make_unique<Daemon>(
        io_, path, "16ms",
        Daemon::Handlers{.on_attached =
                             [this, weak] {
                                 const auto mine = weak.lock();
                                 if (!mine) return;
                                 mine->state.is_attached = true;
                                 mine->state.error.clear();
                                 ask_peer_to_show(mine);
                                 ask_for_scene(mine);
                             },
                         .on_frame =
                             [this, weak](std::string_view line) {
                                 if (const auto mine = weak.lock()) on_peer_frame(*mine, line);
                             },
                         .on_lost =
                             [this, weak](const std::string& why) {
                                 const auto mine = weak.lock();
                                 if (!mine) return;
                                 mine->state.is_attached = false;
                                 mine->state.error = why;
                                 feed_.lose_peer(mine->place);
                                 note("peer",
                                      fmt::format("{} is gone: {}", name_of(mine->place), why));
                             }});
    peers_.push_back(std::move(peer));
}

/// Sorts the peers by their ids, as far as these are known.
void Daemons::order_peers()
{
    std::ranges::stable_sort(peers_, {}, [](const auto& peer) { return peer->state.id(); });
    std::vector<Feed::Source> sources;
    for (std::size_t i = 0; i < peers_.size(); ++i) {
        peers_[i]->place = i;
        sources.push_back({peers_[i]->state.id(), peers_[i]->state.boot_id()});
    }
    if (sources == feed_.peers()) return;
    feed_.set_peers(std::move(sources));
    handlers_.on_other_peers();
}

void Daemons::on_emulator_frame(std::string_view line)
{
    auto frame = parse_emulator_frame(line);
    if (!frame) {
        emulator_state_.error = frame.error().message;
        handlers_.on_news();
        return;
    }
    const auto generation = frame->generation;
    feed_.take_emulator(*std::move(frame));
    if (emulator_state_.paths != feed_.paths()) {
        emulator_state_.paths = feed_.paths();
        handlers_.on_news();
    }
    if (generation != shown_generation_) ask_emulator_to_show();
}

void Daemons::on_peer_frame(Peer& peer, std::string_view line)
{
    auto frame = parse_peer_frame(line);
    if (frame) {
        feed_.take_peer(peer.place, *std::move(frame));
    } else if (peer.state.error != frame.error().message) {
        peer.state.error = frame.error().message;
        handlers_.on_news();
    }
}

void Daemons::ask_emulator_to_show()
{
    if (is_showing_ || !emulator_) return;
    is_showing_ = true;
    emulator_->ask(show_request, [this](const base::Result<Json>& reply) {
        is_showing_ = false;
        if (!reply || !reply->value("ok", false)) return;
        const auto generation = generation_in(*reply);
        if (shown_generation_ > 0 && generation > shown_generation_ &&
            generation > own_generation_) {
            Event event{.at = {}, .kind = "conditions", .text = {}};
            event.text = fmt::format("{}: generation {}",
                                     words_of_change(emulator_state_.shown, *reply), generation);
            event.generation = static_cast<std::int64_t>(generation);
            handlers_.on_event(std::move(event));
        }
        emulator_state_.shown = *reply;
        const auto peers = reply->find("peers");
        if (finds_lab_peers_ && peers != reply->end() && peers->is_number_unsigned() &&
            *peers <= 8) {
            finds_lab_peers_ = false;
            const std::string socket = emulator_state_.socket;
            watch(socket, lab_peer_sockets(socket, peers->get<int>()));
        }
        shown_generation_ = generation;
        handlers_.on_news();
    });
}

void Daemons::ask_peer_to_show(const std::shared_ptr<Peer>& peer)
{
    const std::weak_ptr<Peer> weak = peer;
    peer->daemon->ask(show_request, [this, weak](const base::Result<Json>& reply) {
        const auto mine = weak.lock();
        if (!mine || !reply || !reply->value("ok", false)) return;
        const auto before = text_member(mine->state.shown, "state");
        const auto now = text_member(*reply, "state");
        if (mine->state.shown != *reply) handlers_.on_news();
        mine->state.shown = *reply;
        if (before != now) note("peer", fmt::format("{}: {}", name_of(mine->place), now));
        order_peers();
    });
}

void Daemons::ask_for_scene(const std::shared_ptr<Peer>& peer)
{
    const std::weak_ptr<Peer> weak = peer;
    peer->daemon->ask(scene_request, [this, weak](const base::Result<Json>& reply) {
        const auto mine = weak.lock();
        if (!mine || !reply || !reply->value("ok", false)) return;
        mine->state.scene = *reply;
        mine->state.scene.erase("ok");
        handlers_.on_news();
    });
}

const Daemons::Peer* Daemons::with_hand() const
{
    const auto found = std::ranges::find_if(peers_, [](const auto& peer) {
        return peer->daemon->is_attached() && peer->state.takes_hand();
    });
    return found == peers_.end() ? nullptr : found->get();
}

Daemon* Daemons::peer_with_hand() const
{
    const Peer* peer = with_hand();
    return peer != nullptr ? peer->daemon.get() : nullptr;
}

std::optional<std::uint16_t> Daemons::hand_id() const
{
    const Peer* peer = with_hand();
    return peer != nullptr ? std::optional{peer->state.id()} : std::nullopt;
}

std::vector<PeerState> Daemons::peer_states() const
{
    std::vector<PeerState> states;
    for (const auto& peer : peers_) {
        states.push_back(peer->state);
        states.back().shares_clock =
            peer->place < feed_.peers().size() && feed_.share_clock(0, peer->place);
    }
    return states;
}

std::vector<Daemon*> Daemons::peers() const
{
    std::vector<Daemon*> attached;
    for (const auto& peer : peers_) {
        if (peer->daemon->is_attached()) attached.push_back(peer->daemon.get());
    }
    return attached;
}

Daemon* Daemons::emulator() const
{
    return emulator_ && emulator_->is_attached() ? emulator_.get() : nullptr;
}

} // namespace hapnet::web
