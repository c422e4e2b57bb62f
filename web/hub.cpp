// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/hub.hpp"

#include "proto/base/text.hpp"
#include "proto/base/version.hpp"
#include "proto/control/core/request.hpp"
#include "proto/net/clock.hpp"
#include "web/presets.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::web {

namespace {

constexpr base::Duration state_every{std::chrono::milliseconds{100}};
constexpr base::Duration look_every{std::chrono::milliseconds{500}};
constexpr std::size_t mark_bytes_max = 320; // 80 characters of up to 4 bytes

const std::string show_request = R"({"command":"show"})";
const std::string scene_request = R"({"command":"scene"})";

Viewer::Text shared(std::string text)
{
    return std::make_shared<const std::string>(std::move(text));
}

std::string text_member(const nlohmann::ordered_json& json, const char* key)
{
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

std::uint64_t generation_in(const nlohmann::ordered_json& reply)
{
    const auto found = reply.find("generation");
    return found != reply.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
}

std::size_t characters_in(std::string_view text)
{
    return static_cast<std::size_t>(std::ranges::count_if(
        text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

} // namespace

Hub::Hub(boost::asio::io_context& io) : io_{io}, begun_{net::monotonic_now()} {}

bool Hub::is_virtual() const { return emulator_state_.is_virtual(); }

double Hub::at_s() const
{
    if (is_virtual()) return feed_.elapsed_s().value_or(at_s_told_);
    return base::to_seconds(net::monotonic_now() - begun_);
}

void Hub::attach_lab(const std::string& socket)
{
    finds_lab_peers_ = true;
    set_daemons(socket, {});
}

void Hub::attach(const std::string& emulator, const std::vector<std::string>& peers)
{
    set_daemons(emulator, peers);
}

void Hub::offer(Stage::Setup setup, bool begins, bool is_virtual)
{
    results_.emplace(setup.out);
    stage_ = std::make_unique<Stage>(
        io_, std::move(setup),
        Stage::Handlers{
            .on_change = [this] { has_news_ = true; },
            .on_event = [this](const std::string& text) { note("stage", text); },
            .on_daemons =
                [this](const std::string& emulator, const std::vector<std::string>& peers) {
                    set_daemons(emulator, peers);
                },
            .on_run_end = [this](int run) { results_->look_in(fmt::format("run-{}", run), run); }});
    if (!begins) return;
    Choice choice = stage_->choice();
    if (is_virtual) choice.mode = "virtual";
    if (const auto begun = stage_->start(choice); !begun) {
        note("stage", begun.error().message);
    }
}

void Hub::set_daemons(const std::string& emulator, const std::vector<std::string>& peers)
{
    set_emulator(emulator);
    // The sockets of the next session have the names of the last: these daemons just come back.
    const bool are_same =
        std::ranges::equal(peers, peers_, [](const std::string& path, const auto& peer) {
            return peer->daemon->path() == path;
        });
    if (!are_same) {
        peers_.clear();
        for (const std::string& path : peers) add_peer(path);
        order_peers();
    }
    has_news_ = true;
}

void Hub::set_emulator(const std::string& path)
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

void Hub::add_peer(const std::string& path)
{
    auto peer = std::make_shared<PeerDaemon>();
    peer->state.socket = path;
    peer->place = peers_.size();
    const std::weak_ptr<PeerDaemon> weak = peer; // it has the daemon that has these handlers
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
                                      fmt::format("peer {} is gone: {}", mine->state.id(), why));
                             }});
    peers_.push_back(std::move(peer));
}

/// By their ids, as far as they are known.
void Hub::order_peers()
{
    std::ranges::stable_sort(peers_, {}, [](const auto& peer) { return peer->state.id(); });
    std::vector<Feed::Source> sources;
    for (std::size_t i = 0; i < peers_.size(); ++i) {
        peers_[i]->place = i;
        sources.push_back({peers_[i]->state.id(), peers_[i]->state.boot_id()});
    }
    if (sources == feed_.peers()) return;
    feed_.set_peers(std::move(sources));
    tell_all(shared(fmt::format("{{\"type\":\"reset\",\"at_s\":{:.4f}}}", at_s())));
}

void Hub::on_emulator_frame(std::string_view line)
{
    auto frame = parse_emulator_frame(line);
    if (!frame) {
        emulator_state_.error = frame.error().message;
        has_news_ = true;
        return;
    }
    const auto generation = frame->generation;
    feed_.take_emulator(*std::move(frame));
    if (emulator_state_.paths != feed_.paths()) {
        emulator_state_.paths = feed_.paths();
        has_news_ = true;
    }
    if (generation == shown_generation_) return;
    if (shown_generation_ > 0 && generation > own_generation_ && !is_showing_) {
        Event event{.at = {}, .kind = "conditions", .text = {}};
        event.text = fmt::format("the conditions have changed: generation {}", generation);
        event.generation = static_cast<std::int64_t>(generation);
        note(std::move(event));
    }
    ask_emulator_to_show();
}

void Hub::on_peer_frame(PeerDaemon& peer, std::string_view line)
{
    auto frame = parse_peer_frame(line);
    if (frame) {
        feed_.take_peer(peer.place, *std::move(frame));
    } else if (peer.state.error != frame.error().message) {
        peer.state.error = frame.error().message;
        has_news_ = true;
    }
}

void Hub::ask_emulator_to_show()
{
    if (is_showing_ || !emulator_) return;
    is_showing_ = true;
    emulator_->ask(show_request, [this](const base::Result<Json>& reply) {
        is_showing_ = false;
        if (!reply || !reply->value("ok", false)) return;
        emulator_state_.shown = *reply;
        const auto peers = reply->find("peers");
        if (finds_lab_peers_ && peers != reply->end() && peers->is_number_unsigned() &&
            *peers <= 8) {
            finds_lab_peers_ = false;
            const std::string socket = emulator_state_.socket;
            set_daemons(socket, lab_peer_sockets(socket, peers->get<int>()));
        }
        shown_generation_ = generation_in(*reply);
        has_news_ = true;
    });
}

void Hub::ask_peer_to_show(const std::shared_ptr<PeerDaemon>& peer)
{
    const std::weak_ptr<PeerDaemon> weak = peer;
    peer->daemon->ask(show_request, [this, weak](const base::Result<Json>& reply) {
        const auto mine = weak.lock();
        if (!mine || !reply || !reply->value("ok", false)) return;
        const auto before = text_member(mine->state.shown, "state");
        const auto now = text_member(*reply, "state");
        has_news_ = has_news_ || mine->state.shown != *reply;
        mine->state.shown = *reply;
        if (before != now) note("peer", fmt::format("peer {}: {}", mine->state.id(), now));
        order_peers();
    });
}

void Hub::ask_for_scene(const std::shared_ptr<PeerDaemon>& peer)
{
    const std::weak_ptr<PeerDaemon> weak = peer;
    peer->daemon->ask(scene_request, [this, weak](const base::Result<Json>& reply) {
        const auto mine = weak.lock();
        if (!mine || !reply || !reply->value("ok", false)) return;
        mine->state.scene = *reply;
        mine->state.scene.erase("ok");
        has_news_ = true;
    });
}

nlohmann::ordered_json Hub::state() const
{
    const std::vector<PeerState> peers = peer_states();
    Json trap = trap_.json();
    const auto why_not = why_nothing_is_held(emulator_state_, peers);
    trap["available"] = why_not.empty();
    trap["keys"] = feed_.names();
    Json presets = Json::array();
    for (const Preset& preset : presets_built_in()) presets.push_back({{"name", preset.name}});
    Json stage{{"available", false}, {"state", "stopped"}, {"says", "start hapnet-web --stage"}};
    if (stage_) stage = stage_->json();
    return state_json(at_s(), emulator_state_, peers,
                      {{"presets", std::move(presets)},
                       {"stage", std::move(stage)},
                       {"mode", is_virtual() ? "virtual" : "live"},
                       {"pace", is_virtual() ? emulator_state_.shown["pace"] : Json(nullptr)},
                       {"trap", std::move(trap)},
                       {"keep", {{"available", why_not.empty()}, {"says", why_not}}},
                       {"events", events_.kept()},
                       {"help", help_for(emulator_state_, peers, stage_ != nullptr)}});
}

void Hub::note(const std::string& kind, const std::string& text)
{
    note(Event{.at = {}, .kind = kind, .text = text});
}

void Hub::note(Event event)
{
    event.at = {at_s(), net::wall_clock_nanoseconds() / 1'000'000};
    tell_all(shared(text_of(events_.add(event))));
    has_news_ = true;
}

void Hub::tell_all(const Viewer::Text& text)
{
    const auto viewers = *viewers_; // telling one may make it leave
    for (const auto& [id, viewer] : viewers) viewer.tell(text);
}

void Hub::tell_state(base::TimePoint now)
{
    if (!has_news_ || (next_state_ && !base::is_due(next_state_, now))) return;
    has_news_ = false;
    next_state_ = now + state_every;
    if (viewers_->empty()) return;
    tell_all(shared(text_of(Json{{"type", "state"}, {"state", state()}})));
}

void Hub::tick(base::TimePoint now)
{
    if (stage_) stage_->tick(now);
    saving_.tick(now);
    if (emulator_) emulator_->tick(now);
    for (const auto& peer : peers_) peer->daemon->tick(now);
    if (!next_look_ || base::is_due(next_look_, now)) {
        next_look_ = now + look_every;
        for (const auto& peer : peers_) {
            if (peer->daemon->is_attached()) ask_peer_to_show(peer);
        }
        if (is_virtual()) ask_emulator_to_show(); // how far it is
    }
    tell_frame(now);
    tell_state(now);
}

void Hub::tell_frame(base::TimePoint now)
{
    if (is_virtual()) {
        if (std::exchange(moves_told_, feed_.moves()) == feed_.moves()) return;
        if (at_s() < at_s_told_) {
            feed_.forget();
            tell_all(shared(fmt::format("{{\"type\":\"reset\",\"at_s\":{:.4f}}}", at_s())));
        }
        at_s_told_ = at_s();
    }
    const auto body = feed_.next(at_s(), now);
    if (!body) return;
    const auto viewers = *viewers_;
    for (const auto& [id, viewer] : viewers) viewer.frame(*body);
    step_trap(now);
}

void Hub::step_trap(base::TimePoint now)
{
    switch (trap_.step(feed_.figures(), now)) {
    case Trap::News::none: return;
    case Trap::News::fired: return note("trap", fmt::format("{} came true", trap_.when()));
    case Trap::News::wants_keep:
        return save(free_name("trap"), trap_.last(), [this](const auto& files) {
            if (!files) note("trap", "nothing is saved: " + files.error().message);
        });
    case Trap::News::armed_again: has_news_ = true; return;
    }
}

std::optional<Membership> Hub::join(Viewer viewer)
{
    if (is_full()) return std::nullopt;
    viewer.tell(shared(text_of(Json{{"type", "hello"},
                                    {"schema", 1},
                                    {"version", base::version()},
                                    {"frame_ms", base::to_seconds(frame_every) * 1e3},
                                    {"state", state()}})));
    viewer.tell(shared(feed_.history().fine_json()));
    const auto id = next_viewer_++;
    viewers_->emplace(id, std::move(viewer));
    return Membership{viewers_, id};
}

void Hub::answer(std::string_view path, const std::string& body, const OnReply& on_reply)
{
    if (path == "/api/state") {
        Json json{{"ok", true}};
        json.update(state());
        return on_reply({.body = text_of(json)});
    }
    if (path == "/api/history") return on_reply({.body = feed_.history().coarse_json()});
    if (path == "/api/files") {
        return on_reply(results_ ? results_->list() : fine_reply("files", Json::array()));
    }
    if (path == "/metrics") return metrics_.answer(attached_emulator(), attached_peers(), on_reply);
    if (path.starts_with("/f/")) {
        return on_reply(results_ ? results_->file(path) : error_reply(404, "no such file"));
    }
    const auto request = control::parse_object(body);
    if (!request) return on_reply(error_reply(400, request.error().message));
    if (path == "/api/emulator") return answer_emulator(*request, on_reply);
    if (path == "/api/stage") return answer_stage(*request, on_reply);
    if (path == "/api/trap") return answer_trap(*request, on_reply);
    if (path == "/api/mark") return answer_mark(*request, on_reply);
    if (path == "/api/pace") return answer_pace(*request, on_reply);
    answer_keep(*request, on_reply);
}

void Hub::answer_emulator(const Json& request, const OnReply& on_reply)
{
    constexpr std::array commands{"show", "set", "apply", "diff", "reset"};
    const auto command = text_member(request, "command");
    if (std::ranges::find(commands, command) == commands.end()) {
        return on_reply(
            error_reply(400, "\"command\" must be one of show, set, apply, diff, reset"));
    }
    if (request.contains("file") || request.contains("files")) {
        return on_reply(error_reply(400, "a page may name no files: send the profile itself"));
    }
    if (!emulator_ || !emulator_->is_attached()) {
        return on_reply(error_reply(503, "no emulator is attached"));
    }
    Json asked = request;
    // None but those that the request brings, which are none: the emulator opens no file for a
    // page.
    const bool may_name_files = command == "set" || command == "apply" || command == "diff";
    if (may_name_files) asked["files"] = Json::object();
    emulator_->ask(
        text_of(asked), [this, request, command, on_reply](const base::Result<Json>& reply) {
            if (!reply) return on_reply(error_reply(504, "the emulator: " + reply.error().message));
            const bool is_fine = reply->value("ok", false);
            if (is_fine && reply->value("changed", false)) {
                own_generation_ = std::max(own_generation_, generation_in(*reply));
                Event event{.at = {}, .kind = "conditions", .text = {}};
                event.generation = static_cast<std::int64_t>(generation_in(*reply));
                event.text = command;
                if (command == "set" && request.contains("settings"))
                    event.set = request["settings"];
                for (const char* key : {"preset", "netem"}) {
                    const auto named = text_member(request, key);
                    if (!named.empty()) event.text += " " + named;
                }
                event.text += fmt::format(": generation {}", event.generation);
                note(std::move(event));
                ask_emulator_to_show();
            }
            on_reply({.status = is_fine ? 200 : 422, .body = text_of(*reply)});
        });
}

void Hub::answer_stage(const Json& request, const OnReply& on_reply)
{
    if (!stage_) return on_reply(error_reply(409, "there is no stage: start hapnet-web --stage"));
    const auto what = text_member(request, "do");
    if (what == "stop") {
        stage_->stop();
        return on_reply(fine_reply("stage", stage_->json()));
    }
    if (what != "start" && what != "restart" && what != "loop") {
        return on_reply(error_reply(400, "\"do\" must be one of start, stop, restart, loop"));
    }
    const auto choice = choice_of(request, stage_->choice(), stage_->choices());
    if (!choice) return on_reply(error_reply(400, choice.error().message));
    if (what == "loop") {
        stage_->set_loop(choice->loop);
    } else if (what == "restart") {
        stage_->restart(*choice);
    } else if (const auto begun = stage_->start(*choice); !begun) {
        return on_reply(error_reply(409, begun.error().message));
    }
    on_reply(fine_reply("stage", stage_->json()));
}

void Hub::answer_trap(const Json& request, const OnReply& on_reply)
{
    const auto what = text_member(request, "do");
    if (what == "disarm") {
        trap_.disarm();
    } else if (what == "arm") {
        const auto last = request.contains("last")
                              ? base::parse_duration(text_member(request, "last"))
                              : base::Result<base::Duration>{Trap::last_usual};
        if (!last) return on_reply(error_reply(400, "\"last\": " + last.error().message));
        const auto names = feed_.names();
        const auto armed = trap_.arm(text_member(request, "when"), *last, names);
        if (!armed) return on_reply(error_reply(400, armed.error().message));
    } else {
        return on_reply(error_reply(400, "\"do\" must be arm or disarm"));
    }
    has_news_ = true;
    on_reply(fine_reply("trap", trap_.json()));
}

void Hub::answer_pace(const Json& request, const OnReply& on_reply)
{
    if (!is_virtual()) return on_reply(error_reply(409, "this is live: time cannot be set here"));
    if (request.contains("command")) return on_reply(error_reply(400, "\"do\" says what to do"));
    Json passed{{"command", "pace"}};
    passed.update(request);
    emulator_->ask(text_of(passed), [this, on_reply](const base::Result<Json>& reply) {
        if (!reply) return on_reply(error_reply(504, "hapnet-lab: " + reply.error().message));
        if (!reply->value("ok", false)) return on_reply({.status = 422, .body = text_of(*reply)});
        on_pace(*reply, on_reply);
    });
}

void Hub::on_pace(const Json& reply, const OnReply& on_reply)
{
    Json json = reply;
    if (json.contains("pace")) emulator_state_.shown["pace"] = json["pace"];
    if (const auto path = text_member(json, "file"); !path.empty()) {
        if (stage_) results_->look_in(fmt::format("run-{}", stage_->run()), stage_->run());
        json["file"] = std::filesystem::path{path}.filename().string();
        Event event{.at = {}, .kind = "pace", .text = "saved as an experiment"};
        event.files.push_back(json["file"].get<std::string>());
        note(std::move(event));
    }
    has_news_ = true;
    on_reply({.body = text_of(json)});
}

void Hub::answer_keep(const Json& request, const OnReply& on_reply)
{
    if (const auto why = why_nothing_is_held(emulator_state_, peer_states()); !why.empty()) {
        return on_reply(error_reply(409, why));
    }
    const auto last = request.contains("last") ? base::parse_duration(text_member(request, "last"))
                                               : base::Result<base::Duration>{Trap::last_usual};
    if (!last) return on_reply(error_reply(400, "\"last\": " + last.error().message));
    const auto name = request.contains("name") ? text_member(request, "name") : free_name("keep");
    save(name, *last, [on_reply](const auto& files) {
        if (!files) return on_reply(error_reply(422, files.error().message));
        on_reply(fine_reply("files", *files));
    });
}

/// "trap-2": one that nothing was saved under.
std::string Hub::free_name(const std::string& stem)
{
    std::string name;
    do {
        name = fmt::format("{}-{}", stem, ++saved_);
    } while (stage_ && std::filesystem::exists(stage_->kept() + "/" + name + ".pcapng"));
    return name;
}

/// By all daemons; tells everybody.
void Hub::save(const std::string& name, base::Duration last, Saving::OnSaved on_saved)
{
    std::vector<Daemon*> daemons = attached_peers();
    if (Daemon* emulator = attached_emulator()) daemons.insert(daemons.begin(), emulator);
    saving_.begin(daemons, name, last,
                  [this, name, on_saved = std::move(on_saved)](
                      const base::Result<std::vector<std::string>>& paths) {
                      if (!paths) return on_saved(paths);
                      if (stage_) results_->look_in(Stage::kept_folder, stage_->run());
                      std::vector<std::string> files;
                      for (const std::string& path : *paths) {
                          files.push_back(std::filesystem::path{path}.filename().string());
                      }
                      Event event{.at = {}, .kind = "keep", .text = "saved " + name};
                      event.files = files;
                      note(std::move(event));
                      on_saved(files);
                  });
}

void Hub::answer_mark(const Json& request, const OnReply& on_reply)
{
    const auto text = text_member(request, "text");
    if (text.empty() || text.size() > mark_bytes_max || characters_in(text) > 80) {
        return on_reply(error_reply(400, "\"text\" must have 1 to 80 characters"));
    }
    note("mark", text);
    on_reply({.body = R"({"ok":true})"});
}

std::vector<PeerState> Hub::peer_states() const
{
    std::vector<PeerState> states;
    for (const auto& peer : peers_) {
        states.push_back(peer->state);
        states.back().shares_clock =
            peer->place < feed_.peers().size() && feed_.share_clock(0, peer->place);
    }
    return states;
}

std::vector<Daemon*> Hub::attached_peers() const
{
    std::vector<Daemon*> attached;
    for (const auto& peer : peers_) {
        if (peer->daemon->is_attached()) attached.push_back(peer->daemon.get());
    }
    return attached;
}

Daemon* Hub::attached_emulator() const
{
    return emulator_ && emulator_->is_attached() ? emulator_.get() : nullptr;
}

} // namespace hapnet::web
