// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/hub.hpp"

#include "proto/base/text.hpp"
#include "proto/base/version.hpp"
#include "proto/control/core/request.hpp"
#include "proto/net/clock.hpp"
#include "web/core/condition_words.hpp"
#include "web/core/members.hpp"
#include "web/presets.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::web {

namespace {

constexpr base::Duration state_every{std::chrono::milliseconds{100}};
constexpr std::size_t mark_bytes_max = 320; // 80 characters of up to 4 bytes

Viewer::Text shared(std::string text)
{
    return std::make_shared<const std::string>(std::move(text));
}

} // namespace

Hub::Hub(boost::asio::io_context& io)
    : io_{io},
      begun_{net::monotonic_now()},
      daemons_{io, Daemons::Handlers{.on_news = [this] { has_news_ = true; },
                                     .on_event = [this](Event event) { note(std::move(event)); },
                                     .on_other_peers = [this] { tell_reset(); }}}
{}

double Hub::at_s() const
{
    if (daemons_.is_virtual()) return daemons_.feed().elapsed_s().value_or(at_s_told_);
    return base::to_seconds(net::monotonic_now() - begun_);
}

void Hub::attach_lab(const std::string& socket) { daemons_.watch_lab(socket); }

void Hub::attach(const std::string& emulator, const std::vector<std::string>& peers)
{
    daemons_.watch(emulator, peers);
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
                    daemons_.watch(emulator, peers);
                },
            .on_run_end = [this](int run) { results_->look_in(fmt::format("run-{}", run), run); }});
    if (!begins) return;
    Choice choice = stage_->choice();
    if (is_virtual) choice.mode = "virtual";
    if (const auto begun = stage_->start(choice); !begun) note("stage", begun.error().message);
}

nlohmann::ordered_json Hub::state() const
{
    const std::vector<PeerState> peers = daemons_.peer_states();
    const EmulatorState& emulator = daemons_.emulator_state();
    Json trap = trap_.json();
    const auto why_not = why_nothing_is_held(emulator, peers);
    trap["available"] = why_not.empty();
    trap["keys"] = daemons_.feed().names();
    Json presets = Json::array();
    for (const Preset& preset : presets_built_in()) {
        presets.push_back({{"name", preset.name}, {"about", about_profile(preset.text)}});
    }
    Json stage{{"available", false}, {"state", "stopped"}, {"says", "start hapnet-web --stage"}};
    if (stage_) stage = stage_->json();
    const bool is_paced = emulator.is_virtual() && emulator.is_attached;
    const auto hand = daemons_.hand_id();
    const Json own = hand ? Json(*hand) : Json(nullptr);
    return state_json(at_s(), emulator, peers,
                      {{"presets", std::move(presets)},
                       {"stage", std::move(stage)},
                       {"mode", emulator.is_virtual() ? "virtual" : "live"},
                       {"pace", is_paced ? emulator.shown["pace"] : Json(nullptr)},
                       {"trap", std::move(trap)},
                       {"hand", {{"peer", own}, {"held", hand_.is_held()}}},
                       {"keep", {{"available", why_not.empty()}, {"says", why_not}}},
                       {"events", events_.kept()},
                       {"help", help_for(emulator, peers, stage_ != nullptr)}});
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
    const auto viewers = *viewers_; // a copy: a viewer may leave during the loop
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
    daemons_.tick(now);
    has_news_ = hand_.tick(daemons_.peer_with_hand(), now) || has_news_;
    tell_frame(now);
    tell_state(now);
}

/// Tells all viewers that the live figures are cleared.
void Hub::tell_reset()
{
    tell_all(shared(fmt::format("{{\"type\":\"reset\",\"at_s\":{:.4f}}}", at_s())));
}

void Hub::tell_frame(base::TimePoint now)
{
    Feed& feed = daemons_.feed();
    if (daemons_.is_virtual()) {
        if (std::exchange(moves_told_, feed.moves()) == feed.moves()) return;
        if (at_s() < at_s_told_) {
            feed.forget();
            tell_reset();
        }
        at_s_told_ = at_s();
    }
    const auto body = feed.next(at_s(), now);
    if (!body) return;
    const auto viewers = *viewers_;
    for (const auto& [id, viewer] : viewers) viewer.frame(*body);
    step_trap(now);
}

void Hub::step_trap(base::TimePoint now)
{
    switch (trap_.step(daemons_.feed().figures(), now)) {
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
    viewer.tell(shared(daemons_.feed().history().fine_json()));
    // While virtual time stands still no other frame arrives.
    const auto newest = daemons_.feed().newest(at_s(), net::monotonic_now());
    if (daemons_.is_virtual() && newest) viewer.frame(*newest);
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
    if (path == "/api/history") return on_reply({.body = daemons_.feed().history().coarse_json()});
    if (path == "/api/files") {
        return on_reply(results_ ? results_->list() : fine_reply("files", Json::array()));
    }
    if (path == "/metrics") return metrics_.answer(daemons_.emulator(), daemons_.peers(), on_reply);
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
    Daemon* emulator = daemons_.emulator();
    if (emulator == nullptr) return on_reply(error_reply(503, "no emulator is attached"));
    Json asked = request;
    // The request may only use files that it contains. It contains none, so the emulator opens no
    // file for a page.
    const bool may_name_files = command == "set" || command == "apply" || command == "diff";
    if (may_name_files) asked["files"] = Json::object();
    emulator->ask(
        text_of(asked), [this, request, command, on_reply](const base::Result<Json>& reply) {
            if (!reply) return on_reply(error_reply(504, "the emulator: " + reply.error().message));
            const bool is_fine = reply->value("ok", false);
            if (is_fine && reply->value("changed", false)) {
                Event event{.at = {}, .kind = "conditions", .text = {}};
                event.generation = static_cast<std::int64_t>(generation_in(*reply));
                event.text = command;
                if (command == "set" && request.contains("settings")) {
                    event.set = request["settings"];
                    event.text += " " + words_of(event.set);
                }
                for (const char* key : {"preset", "netem"}) {
                    const auto named = text_member(request, key);
                    if (!named.empty()) event.text += " " + named;
                }
                event.text += fmt::format(": generation {}", event.generation);
                note(std::move(event));
                daemons_.know_generation(generation_in(*reply));
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
        const auto names = daemons_.feed().names();
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
    Daemon* lab = daemons_.is_virtual() ? daemons_.emulator() : nullptr;
    if (lab == nullptr) return on_reply(error_reply(409, "this is live: time cannot be set here"));
    if (request.contains("command")) return on_reply(error_reply(400, "\"do\" says what to do"));
    Json passed{{"command", "pace"}};
    passed.update(request);
    lab->ask(text_of(passed), [this, on_reply](const base::Result<Json>& reply) {
        if (!reply) return on_reply(error_reply(504, "hapnet-lab: " + reply.error().message));
        if (!reply->value("ok", false)) return on_reply({.status = 422, .body = text_of(*reply)});
        on_pace(*reply, on_reply);
    });
}

void Hub::on_pace(const Json& reply, const OnReply& on_reply)
{
    Json json = reply;
    if (json.contains("pace")) daemons_.know_pace(json["pace"]);
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
    if (const auto why = why_nothing_is_held(daemons_.emulator_state(), daemons_.peer_states());
        !why.empty()) {
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

/// Returns a name such as "trap-2" under which nothing has been saved.
std::string Hub::free_name(const std::string& stem)
{
    std::string name;
    do {
        name = fmt::format("{}-{}", stem, ++saved_);
    } while (stage_ && std::filesystem::exists(stage_->kept() + "/" + name + ".pcapng"));
    return name;
}

/// Makes all daemons save their last seconds, and tells all viewers of the files.
void Hub::save(const std::string& name, base::Duration last, Saving::OnSaved on_saved)
{
    std::vector<Daemon*> daemons = daemons_.peers();
    if (Daemon* emulator = daemons_.emulator()) daemons.insert(daemons.begin(), emulator);
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

void Hub::hand(std::uint64_t page, const HandMessage& message)
{
    Daemon* peer = daemons_.peer_with_hand();
    if (peer == nullptr) return;
    const auto told = hand_.on_message(page, message, *peer, net::monotonic_now());
    if (!told.empty()) viewers_->at(page).tell(shared(told));
}

} // namespace hapnet::web
