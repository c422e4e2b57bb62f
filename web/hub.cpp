// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/hub.hpp"

#include "proto/base/text.hpp"
#include "proto/base/version.hpp"
#include "proto/control/core/request.hpp"
#include "proto/net/clock.hpp"
#include "web/core/metrics.hpp"
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
constexpr base::Duration metrics_for{std::chrono::seconds{1}};
constexpr std::size_t mark_bytes_max = 320; // 80 characters of up to 4 bytes
constexpr std::size_t files_max = 10'000;

const std::string show_request = R"({"command":"show"})";
const std::string scene_request = R"({"command":"scene"})";
const std::string stats_request = R"({"command":"stats"})";

std::string text_of(const nlohmann::ordered_json& json)
{
    using Json = nlohmann::ordered_json;
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

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

Reply fine(const char* key, nlohmann::ordered_json value)
{
    nlohmann::ordered_json json{{"ok", true}};
    json[key] = std::move(value);
    return {.body = text_of(json)};
}

std::size_t characters_in(std::string_view text)
{
    return static_cast<std::size_t>(std::ranges::count_if(
        text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

} // namespace

Reply error_reply(int status, std::string_view error)
{
    return {.status = status,
            .body = text_of(nlohmann::ordered_json{{"ok", false}, {"error", error}})};
}

Hub::Hub(boost::asio::io_context& io) : io_{io}, begun_{net::monotonic_now()} {}

double Hub::at_s() const { return base::to_seconds(net::monotonic_now() - begun_); }

void Hub::attach(const std::string& emulator, const std::vector<std::string>& peers)
{
    set_daemons(emulator, peers);
}

void Hub::offer(Stage::Setup setup, bool begins)
{
    stage_ = std::make_unique<Stage>(
        io_, std::move(setup),
        Stage::Handlers{
            .on_change = [this] { has_news_ = true; },
            .on_event = [this](const std::string& text) { note("stage", text); },
            .on_daemons =
                [this](const std::string& emulator, const std::vector<std::string>& peers) {
                    set_daemons(emulator, peers);
                },
            .on_run_end = [this](int run) { find_files(run); }});
    if (!begins) return;
    if (const auto begun = stage_->start(stage_->choice()); !begun) {
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
    std::vector<PeerState> peers;
    for (const auto& peer : peers_) peers.push_back(peer->state);
    Json trap = trap_.json();
    trap["available"] = false; // no daemon keeps its last seconds
    trap["keys"] = feed_.names();
    Json presets = Json::array();
    for (const Preset& preset : presets_built_in()) presets.push_back({{"name", preset.name}});
    Json stage{{"available", false}, {"state", "stopped"}, {"says", "start hapnet-web --stage"}};
    if (stage_) stage = stage_->json();
    return state_json(
        at_s(), emulator_state_, peers,
        {{"presets", std::move(presets)},
         {"stage", std::move(stage)},
         {"pace", nullptr},
         {"trap", std::move(trap)},
         {"keep", {{"available", false}, {"says", "these daemons do not keep their last seconds"}}},
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
    const auto viewers = viewers_; // telling one may make it leave
    for (const auto& [id, viewer] : viewers) viewer.tell(text);
}

void Hub::tell_state(base::TimePoint now)
{
    if (!has_news_ || (next_state_ && !base::is_due(next_state_, now))) return;
    has_news_ = false;
    next_state_ = now + state_every;
    if (viewers_.empty()) return;
    tell_all(shared(text_of(Json{{"type", "state"}, {"state", state()}})));
}

void Hub::tick(base::TimePoint now)
{
    if (stage_) stage_->tick(now);
    if (emulator_) emulator_->tick(now);
    for (const auto& peer : peers_) peer->daemon->tick(now);
    if (!next_look_ || base::is_due(next_look_, now)) {
        next_look_ = now + look_every;
        for (const auto& peer : peers_) {
            if (peer->daemon->is_attached()) ask_peer_to_show(peer);
        }
    }
    if (const auto body = feed_.next(base::to_seconds(now - begun_), now)) {
        const auto viewers = viewers_;
        for (const auto& [id, viewer] : viewers) viewer.frame(*body);
        step_trap(now);
    }
    tell_state(now);
}

void Hub::step_trap(base::TimePoint now)
{
    switch (trap_.step(feed_.figures(), now)) {
    case Trap::News::none: return;
    case Trap::News::fired: return note("trap", fmt::format("{} came true", trap_.when()));
    case Trap::News::wants_keep:
        return note("trap", fmt::format("{}: marked; these daemons do not keep their last seconds",
                                        trap_.when()));
    case Trap::News::armed_again: has_news_ = true; return;
    }
}

std::optional<std::uint64_t> Hub::join(Viewer viewer)
{
    if (is_full()) return std::nullopt;
    viewer.tell(shared(text_of(Json{{"type", "hello"},
                                    {"schema", 1},
                                    {"version", base::version()},
                                    {"frame_ms", base::to_seconds(frame_every) * 1e3},
                                    {"state", state()}})));
    viewer.tell(shared(feed_.history().fine_json()));
    const auto id = next_viewer_++;
    viewers_.emplace(id, std::move(viewer));
    return id;
}

void Hub::answer(std::string_view path, const std::string& body, const OnReply& on_reply)
{
    if (path == "/api/state") {
        Json json{{"ok", true}};
        json.update(state());
        return on_reply({.body = text_of(json)});
    }
    if (path == "/api/history") return on_reply({.body = feed_.history().coarse_json()});
    if (path == "/api/files") return on_reply(files());
    if (path == "/metrics") return answer_metrics(on_reply);
    if (path.starts_with("/f/")) return answer_file(path, on_reply);
    const auto request = control::parse_object(body);
    if (!request) return on_reply(error_reply(400, request.error().message));
    if (path == "/api/emulator") return answer_emulator(*request, on_reply);
    if (path == "/api/stage") return answer_stage(*request, on_reply);
    if (path == "/api/trap") return answer_trap(*request, on_reply);
    if (path == "/api/mark") return answer_mark(*request, on_reply);
    if (path == "/api/pace") {
        return on_reply(error_reply(409, "this is live: time cannot be set here"));
    }
    on_reply(error_reply(409, "these daemons do not keep their last seconds"));
}

void Hub::answer_emulator(const Json& request, const OnReply& on_reply)
{
    constexpr std::array commands{"show", "set", "apply", "diff", "reset"};
    const auto command = text_member(request, "command");
    if (std::ranges::find(commands, command) == commands.end()) {
        return on_reply(
            error_reply(400, "\"command\" must be one of show, set, apply, diff, reset"));
    }
    if (request.contains("file")) {
        return on_reply(error_reply(400, "\"file\" is not known here: send the profile itself"));
    }
    if (!emulator_ || !emulator_->is_attached()) {
        return on_reply(error_reply(503, "no emulator is attached"));
    }
    emulator_->ask(
        text_of(request), [this, request, command, on_reply](const base::Result<Json>& reply) {
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
        return on_reply(fine("stage", stage_->json()));
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
    on_reply(fine("stage", stage_->json()));
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
    on_reply(fine("trap", trap_.json()));
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

void Hub::answer_metrics(const OnReply& on_reply)
{
    const auto plain = [on_reply](const std::string& text) {
        on_reply({.body = text, .type = "text/plain; version=0.0.4; charset=utf-8"});
    };
    const auto now = net::monotonic_now();
    if (metrics_until_ && !base::is_due(metrics_until_, now)) return plain(metrics_);
    struct Gathered {
        Json emulator = nullptr;
        std::vector<Json> peers;
        std::size_t awaited = 1;
    };
    auto gathered = std::make_shared<Gathered>();
    metrics_until_ = now + metrics_for;
    const auto one_more = [this, gathered, plain] {
        if (--gathered->awaited > 0) return;
        metrics_ = prometheus_text(gathered->emulator, gathered->peers);
        plain(metrics_);
    };
    if (emulator_ && emulator_->is_attached()) {
        ++gathered->awaited;
        emulator_->ask(stats_request, [gathered, one_more](const base::Result<Json>& reply) {
            if (reply) gathered->emulator = *reply;
            one_more();
        });
    }
    for (const auto& peer : peers_) {
        if (!peer->daemon->is_attached()) continue;
        ++gathered->awaited;
        peer->daemon->ask(stats_request, [gathered, one_more](const base::Result<Json>& reply) {
            if (reply) gathered->peers.push_back(*reply);
            one_more();
        });
    }
    one_more();
}

/// What a run has left behind: of known names only.
void Hub::find_files(int run)
{
    struct Known {
        std::string_view ending;
        std::string_view kind;
    };
    constexpr std::array known{Known{".pcapng", "capture"}, Known{".rec", "record"},
                               Known{".csv", "csv"}, Known{".toml", "profile"},
                               Known{".json", "statistics"}};
    const std::string folder = fmt::format("run-{}", run);
    std::error_code trouble;
    std::vector<std::string> names;
    for (const auto& entry :
         std::filesystem::directory_iterator{stage_->out() + "/" + folder, trouble}) {
        if (entry.is_regular_file(trouble)) names.push_back(entry.path().filename().string());
    }
    std::ranges::sort(names);
    for (const std::string& name : names) {
        const auto kind = std::ranges::find_if(
            known, [&](const Known& one) { return name.ends_with(one.ending); });
        const std::string shown = folder + "/" + name;
        const bool is_there = std::ranges::find(files_, shown, &File::name) != files_.end();
        if (kind == known.end() || is_there || files_.size() >= files_max) continue;
        files_.push_back({shown, stage_->out() + "/" + shown, std::string{kind->kind}, run});
    }
}

Reply Hub::files() const
{
    Json list = Json::array();
    for (std::size_t i = 0; i < files_.size(); ++i) {
        const File& file = files_[i];
        std::error_code trouble;
        const auto bytes = std::filesystem::file_size(file.path, trouble);
        if (trouble) continue;
        list.push_back({{"name", file.name},
                        {"bytes", bytes},
                        {"kind", file.kind},
                        {"run", file.run},
                        {"href", fmt::format("/f/{}", i)}});
    }
    return fine("files", std::move(list));
}

void Hub::answer_file(std::string_view path, const OnReply& on_reply) const
{
    constexpr std::string_view folder = "/f/";
    const auto number = base::parse_count(path.substr(folder.size()), files_max);
    if (!number || *number >= files_.size()) return on_reply(error_reply(404, "no such file"));
    const File& file = files_[*number];
    std::string name = file.name;
    std::ranges::replace(name, '/', '-');
    on_reply({.body = {},
              .type = "application/octet-stream",
              .file = file.path,
              .attached_as = std::move(name)});
}

} // namespace hapnet::web
