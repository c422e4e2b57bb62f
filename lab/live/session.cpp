// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/live/session.hpp"

#include "emulator/control/reply.hpp"
#include "emulator/control/settings.hpp"
#include "emulator/core/direction_report.hpp"
#include "lab/experiment/session_spec.hpp"
#include "lab/live/pace.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/control/core/reply.hpp"
#include "proto/record/rows.hpp"

#include <algorithm>
#include <bit>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <variant>

namespace hapnet::lab::live {

namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

/// The usual time from the first hello to the start, in which the peers hear each other and count
/// down.
constexpr base::Duration usual_countdown = 1s;
/// A change at a time takes effect after the ticks of that time, like a step of a timeline.
constexpr base::Duration after_the_ticks = 1ns;
/// Room for 16 s of datagrams, more than a page can request.
constexpr emulator::QueueLimits roomy{.datagrams_max = 16384, .bytes_max = 64U << 20};

/// True if a request of this kind may change the conditions.
bool may_change(std::string_view line)
{
    const auto request = emulator::parse_request(line);
    return request && (std::holds_alternative<emulator::SetRequest>(*request) ||
                       std::holds_alternative<emulator::ApplyRequest>(*request) ||
                       std::holds_alternative<emulator::ResetRequest>(*request));
}

bool is_in_session(const virtual_time::VirtualPlayer& player)
{
    return player.peer().session().has_value();
}

} // namespace

base::Result<std::unique_ptr<Session>> Session::make(const experiment::Experiment& experiment,
                                                     Presets presets, HandOfA hand_of_a)
{
    if (!experiment.axes.empty())
        return base::fail("an experiment with an axis is many: choose one value");
    if (experiment.algorithms.size() > algorithms_max) {
        return base::fail(fmt::format("{} algorithms: at most {} play side by side",
                                      experiment.algorithms.size(), algorithms_max));
    }
    std::vector<virtual_time::Setting> settings;
    const experiment::Party party = experiment::parties_of(experiment).front();
    for (const experiment::NamedAlgorithm& algorithm : experiment.algorithms) {
        const auto spec = experiment::make_session_spec(
            experiment,
            {algorithm, experiment.hands, experiment.tasks.front(), experiment.first_seed, party},
            experiment.path);
        if (auto valid = validate(spec.setting); !valid) return tl::unexpected{valid.error()};
        settings.push_back(spec.setting);
        auto& player = settings.back().players.front();
        if (hand_of_a == HandOfA::simulated) continue;
        if (player.replay || player.way)
            return base::fail("A's hand is that of a page: leave its replay or script out");
        player.page = std::make_shared<device::HandWishes>();
    }
    return std::unique_ptr<Session>{
        new Session{experiment, std::move(settings), std::move(presets)}};
}

Session::Session(const experiment::Experiment& experiment,
                 std::vector<virtual_time::Setting> settings, Presets presets)
    : experiment_{experiment}, settings_{std::move(settings)}, presets_{std::move(presets)}
{
    for (std::size_t seat = 0; seat < peers(); ++seat) {
        taps_.emplace_back(static_cast<std::uint16_t>(seat + 1));
    }
    begin();
}

/// Starts everything again from its beginning. The world and the watched frames are replaced.
void Session::begin()
{
    journals_.clear();
    emulations_.clear();
    hand_.clear();
    for (virtual_time::Setting& setting : settings_) {
        auto& page = setting.players.front().page;
        if (page) page = std::make_shared<device::HandWishes>(); // drops earlier wishes
    }
    world_ = std::make_unique<World>(settings_, roomy);
    for (std::size_t group = 0; group < world_->groups(); ++group) {
        emulations_.push_back(
            {.paths = world_->paths(group),
             .statistics = [this](const control::DoWork&) { return statistics(); },
             .stop = [] {},
             .preset = presets_});
    }
    frames_ = std::make_shared<emulator::Frames>();
    for (std::size_t seat = 0; seat < peers(); ++seat) {
        journals_.emplace_back(world_->side(seat), [this, seat](const record::Row& row) {
            const bool is_session = std::holds_alternative<record::SessionRow>(row);
            if (is_shown_ || is_session) taps_[seat].take(row); // taps always need session rows
        });
        taps_[seat].begin_anew();
    }
    world_->intercept([this](const World::Arrival& arrival) {
        const std::size_t from = world_->seat_of(arrival.from);
        const std::size_t to = world_->seat_of(arrival.to);
        if (world_->group_of(arrival.to) == 0) journals_[to].on_message(from, arrival);
        world_->side(arrival.to).receive(from < to ? from : from - 1, arrival.datagram, arrival.at);
    });
    ++lives_;
    done_ = 0;
    digest_ = 0xcbf2'9ce4'8422'2325U;
}

base::Duration Session::length() const
{
    const auto& session = world_->side(0).peer().session();
    const base::Duration length = settings_.front().length;
    if (!session) return usual_countdown + length;
    return session->start - world_->side(0).clock_ahead - World::start + length;
}

void Session::play_to(base::Duration time)
{
    // The session's length is certain only when the session is agreed on.
    while (at() < std::min(time, length())) {
        const base::Duration end = std::min(time, length());
        const bool is_next = done_ < requests_.size() && requests_[done_].at <= end;
        run_to(World::start + (is_next ? requests_[done_].at : end));
        if (is_next) apply(requests_[done_++]);
    }
}

void Session::run_to(base::TimePoint end)
{
    while (world_->next_deadline() <= end) step();
    world_->run_for(end - world_->now());
}

void Session::step()
{
    world_->step();
    for (std::size_t side = 0; side < world_->sides(); ++side) {
        const virtual_time::VirtualPlayer& player = world_->side(side);
        if (player.stepped_at != world_->now()) continue;
        if (is_in_session(player)) note(player);
        if (side < journals_.size()) journals_[side].on_tick();
        if (side == 0 && has_page_hand() && is_in_session(player)) note_hand();
    }
}

/// Records the motion of A's hand in the first session. The motion is the same in all sessions.
void Session::note_hand()
{
    const virtual_time::VirtualPlayer& player = world_->side(0);
    const base::TimePoint start = player.peer().session()->start;
    const device::Sample& sample = player.side->sample();
    const device::HandMoment moment{
        .time_s = base::to_seconds(player.stepped_at + player.clock_ahead - start),
        .hip = sample.hip,
        .gripping = sample.gripping,
        .docked = sample.docked};
    const auto rests = [&](const device::HandMoment& before) {
        return before.hip == moment.hip && before.docked == moment.docked &&
               before.gripping == moment.gripping;
    };
    // The first and the last moment describe a hand at rest.
    const std::size_t count = hand_.size();
    if (count >= 2 && rests(hand_[count - 1]) && rests(hand_[count - 2])) hand_.pop_back();
    hand_.push_back(moment);
}

void Session::hand(const std::optional<device::HandWish>& wish)
{
    keep({.at = at(), .line = {}, .hand = wish});
    apply(requests_.back());
}

/// Adds a request and drops later ones, which a seek has left behind. Of several wishes at the same
/// time only the last is kept.
void Session::keep(Request request)
{
    requests_.erase(requests_.begin() + static_cast<std::ptrdiff_t>(done_), requests_.end());
    const bool is_newer_wish = request.is_for_hand() && !requests_.empty() &&
                               requests_.back().is_for_hand() && requests_.back().at == request.at;
    if (is_newer_wish) requests_.pop_back();
    requests_.push_back(std::move(request));
    done_ = requests_.size();
}

void Session::apply(const Request& request)
{
    if (!request.is_for_hand()) return static_cast<void>(apply(request.line));
    for (const virtual_time::Setting& setting : settings_)
        setting.players.front().page->put(request.hand);
}

/// Adds a player's state to the digest: FNV-1a of whole numbers.
void Session::note(const virtual_time::VirtualPlayer& player)
{
    const virtual_time::Sample sample = player.sample();
    const auto add = [this](double value) {
        digest_ = (digest_ ^ std::bit_cast<std::uint64_t>(value)) * 0x0000'0100'0000'01b3U;
    };
    for (const glm::dvec3& part : {sample.body.value, sample.body_velocity.value, sample.hip.value,
                                   sample.on_hand.value, sample.on_body.value}) {
        add(part.x);
        add(part.y);
        add(part.z);
    }
}

void Session::seek(base::Duration time)
{
    time = std::max(time, base::Duration{0});
    if (time < at()) begin();
    is_shown_ = false;
    play_to(std::max(at(), time - shown_of_a_seek));
    is_shown_ = true;
    for (auto& tap : taps_) tap.skip();
    play_to(time);
}

std::string Session::apply(const std::string& line)
{
    std::string first;
    for (emulator::Emulation& emulation : emulations_) {
        const auto answer = emulator::answer_to(line, emulation, world_->now());
        if (first.empty()) first = std::get<std::string>(answer);
    }
    return first;
}

control::Answer Session::answer(std::string_view line)
{
    if (!may_change(line)) {
        return emulator::answer_to(line, emulations_.front(), world_->now());
    }
    play_to(at() + after_the_ticks);
    const std::uint64_t before = emulations_.front().paths.generation();
    std::string text{line};
    std::string reply = apply(text);
    if (emulations_.front().paths.generation() == before) return reply;
    keep({.at = at(), .line = std::move(text)});
    return reply;
}

nlohmann::ordered_json Session::statistics() const
{
    const emulator::Link& up = world_->link(0, 1);
    const emulator::Link& down = world_->link(1, 0);
    const auto told = [](const emulator::Link& link) {
        return base::json_of(emulator::DirectionReport{
            .statistics = &link.statistics(), .stream = &link.stream_statistics().totals()});
    };
    return {{"program", "hapnet-lab"}, {"up", told(up)}, {"down", told(down)}, {"valid", true}};
}

control::FrameSource Session::watch()
{
    struct Watch {
        std::uint64_t life = 0;
        control::FrameSource next;
    };
    return [this, watch = std::make_shared<Watch>()](std::string& text, std::uint64_t left_out) {
        if (watch->life != lives_) {
            *watch = {lives_, frames_->watch(emulations_.front().paths, control::do_at_once)};
        }
        emulations_.front().paths.catch_up(world_->now());
        watch->next(text, left_out);
        append_others(text);
    };
}

void Session::append_others(std::string& text) const
{
    if (world_->groups() < 2 || text.empty()) return;
    std::vector<OtherSession> others;
    for (std::size_t group = 1; group < world_->groups(); ++group) {
        others.push_back({experiment_.algorithms[group].name,
                          world_->side(group * peers()).peer().position(),
                          world_->side(group * peers() + 1).peer().position()});
    }
    text.pop_back();
    text += ",\"others\":" + control::line_of(base::json_of(others)) + '}';
}

PeerIntroduction Session::introduce_peer(std::size_t seat) const
{
    const virtual_time::Setting& setting = settings_.front();
    const bool is_page = seat == 0 && has_page_hand();
    return {.peer_id = static_cast<std::int64_t>(seat + 1),
            .task = setting.task,
            .scene = setting.scene.name,
            .algorithm = experiment_.algorithms.front().name,
            .seed = setting.seed.value(),
            .duration = setting.length,
            .device =
                is_page ? "page: a hand on a page, in virtual time" : PeerIntroduction{}.device,
            .takes_hand = is_page,
            .force_limit_n = world_->side(seat).rig.governor().limits().force_max_n,
            .elapsed = at()};
}

nlohmann::ordered_json Session::peer_statistics(std::size_t seat) const
{
    const virtual_time::VirtualPlayer& player = world_->side(seat);
    return base::json_of(PeerStatistics{
        .introduction = introduce_peer(seat),
        .tick = {.count = journals_[seat].ticks(), .missed = 0, .late = base::Quantiles{}},
        .messages = player.peer().counters(),
        .governor = peer::governor_figures(player.rig)});
}

nlohmann::ordered_json Session::show_peer(std::size_t seat) const
{
    const virtual_time::VirtualPlayer& player = world_->side(seat);
    const auto& session = player.peer().session();
    const auto phase = std::string{record::name_of(player.last().phase)};
    Json agreed = nullptr;
    if (session) {
        const base::TimePoint start = session->start - player.clock_ahead;
        agreed = {{"number", session->number},
                  {"role", base::name_of(seat % 2 == 0 ? peer::Role::left : peer::Role::right)},
                  {"at_s", base::to_seconds(world_->now() - start)}};
    }
    Json shown = base::json_of(introduce_peer(seat));
    shown.update({{"tick_rate_hz", 1.0 / base::to_seconds(settings_.front().tick)},
                  {"boot_id", "virtual time"},
                  {"held_s", nullptr},
                  {"state", phase},
                  {"says", "plays in virtual time"},
                  {"phase", phase},
                  {"session", std::move(agreed)},
                  {"force_n", base::norm(player.told())},
                  {"governor", device::name_of(player.rig.governor().state())},
                  {"fault", nullptr}});
    return shown;
}

nlohmann::ordered_json Session::steps() const
{
    Json steps = Json::array();
    for (const auto& [name, path] : world_->paths().all()) {
        for (const emulator::ConditionChange& change : path->changes().entries()) {
            Json settings = Json::object();
            for (const auto way : {emulator::Direction::up, emulator::Direction::down}) {
                for (const auto& [key, value] : emulator::texts_of(way, change.patch(way), name))
                    settings[key] = value;
            }
            steps.push_back(
                {{"at_s", base::to_seconds(change.elapsed)}, {"settings", std::move(settings)}});
        }
    }
    return steps;
}

base::Result<experiment::Experiment> Session::as_experiment() const
{
    if (peers() != 2) return base::fail("only sessions of two are saved as an experiment");
    const auto is_ramp = [](const emulator::Change& change) { return change.ramp > 0ns; };
    const auto& path = *world_->paths().all().front().path;
    const auto remaining = world_->paths().deciders().back().director->remaining().timeline;
    if (std::ranges::any_of(settings_.front().profile.timeline, is_ramp) ||
        std::ranges::any_of(remaining, is_ramp) || path.changes().omitted() > 0) {
        return base::fail("what changes all the time, as in a ramp, is not saved as an experiment");
    }
    experiment::Experiment saved = experiment_;
    saved.title = "played by hand";
    saved.kind = experiment::Trajectories{};
    saved.seeds = 1;
    saved.tasks.resize(1);
    saved.peers = {2};
    saved.record = !saved.keyed;
    if (has_page_hand()) {
        if (hand_.empty()) return base::fail("the session has not begun: play on, then save");
        saved.replay = {{.name = {}, .trace = std::make_shared<const device::HandTrace>(hand_)},
                        {}};
    }
    saved.timeline.clear();
    for (const emulator::ConditionChange& change : path.changes().entries()) {
        saved.timeline.push_back({.time = change.elapsed,
                                  .up = change.patch(emulator::Direction::up),
                                  .down = change.patch(emulator::Direction::down)});
    }
    for (emulator::Change change : remaining) {
        change.time += at();
        saved.timeline.push_back(std::move(change));
    }
    return saved;
}

} // namespace hapnet::lab::live
