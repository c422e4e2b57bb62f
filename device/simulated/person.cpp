// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/person.hpp"

#include "device/simulated/minimum_jerk.hpp"

#include <chrono>

namespace hapnet::device {

namespace {

// The time that the hand takes from its rest position to its part.
constexpr double approach_s = 0.8;

// A governor requires a second of rest before a press. The hand waits half a second more, to come
// to rest.
constexpr base::Duration rest_before_press{std::chrono::milliseconds{1500}};
constexpr base::Duration press_length{std::chrono::milliseconds{400}}; // a press counts after 0.3 s
constexpr base::Duration press_every{std::chrono::seconds{2}};

} // namespace

Person::Person(const Role& role) : role_{role}, reactions_{role.person} {}

void Person::on_cue(const Cue& cue, const glm::dvec3& rest)
{
    part_ = Part{Script{role_.task, cue, role_.options, role_.person.hand},
                 HandNoise{cue.seed, cue.peer_id, role_.person}, cue.start, role_.task == Task::p1};
    if (role_.way) part_->script.follow(role_.way);
    cued_at_.reset();
    rest_ = rest;
}

void Person::on_fault(bool is_latched)
{
    if (is_latched) {
        pause_ = Pause{};
    } else if (pause_) {
        pause_->is_over = true;
    }
}

Person::Aim Person::aim(base::TimePoint now)
{
    Aim aim = aim_of_part(now);
    if (pause_ && part_) aim = paused(aim, now);
    meant_ = aim.intention.target;
    return aim;
}

Person::Aim Person::paused(const Aim& aim, base::TimePoint now)
{
    if (pause_->is_over) {
        if (!pause_->left) {
            pause_->left = now;
            // The pause may end before the hand has noticed it.
            if (!pause_->since) pause_->place = meant_;
        }
        const double u = base::to_seconds(now - *pause_->left) / approach_s;
        if (u >= 1.0) {
            pause_.reset();
            return aim;
        }
        Aim back = aim;
        const base::Position& stayed = pause_->place;
        back.intention.target = stayed + minimum_jerk(u) * (aim.intention.target - stayed);
        return back;
    }
    if (!pause_->since) {
        pause_->since = now;
        pause_->place = meant_;
    }
    const base::Duration into = (now - *pause_->since) % press_every;
    const bool presses = into >= rest_before_press && into < rest_before_press + press_length;
    return {.intention = {.target = pause_->place, .gripping = presses}};
}

Person::Aim Person::aim_of_part(base::TimePoint now)
{
    if (!part_) return {.intention = {.target = {rest_}}};
    if (!cued_at_) cued_at_ = now;
    Aim aim{.intention = part_->script.at(now)};
    glm::dvec3& target = aim.intention.target.value;
    if (aim.intention.searching) aim.searched_x = target.x;
    if (!part_->is_prescribed) {
        const HandNoise::Value noise = part_->noise.at(base::to_seconds(now - part_->start));
        target.x += noise.away_m;
        aim.force_share = noise.force_share;
    }
    // The hand moves aside first, and then to the part, because the straight path might push the
    // cube.
    const double u = base::to_seconds(now - *cued_at_) / approach_s;
    if (u >= 1.0) return aim;
    const glm::dvec3 aside{part_->script.aside_x(), 0.0, rest_.z};
    const glm::dvec3 on_the_way = rest_ + minimum_jerk(2.0 * u) * (aside - rest_);
    target = on_the_way + minimum_jerk(2.0 * u - 1.0) * (target - on_the_way);
    return aim;
}

Person::Effort Person::effort(const Aim& aim, const Feedback& feedback, base::TimePoint now,
                              base::Duration elapsed)
{
    Effort effort{.target = aim.intention.target};
    if (!part_ || part_->is_prescribed) return effort;
    const double toward = part_->script.pressing_toward();
    Perception felt{feedback.deviation, -toward * feedback.force.x, aim.intention.pressing_n, {}};
    if (aim.searched_x) felt.aim_m = toward * *aim.searched_x;
    const Reaction reaction = reactions_.to(felt, now, elapsed);
    effort.target.value.x += toward * reaction.farther_m;
    effort.force =
        reaction.force - (aim.force_share * hand().stiffness_n_per_m) * feedback.deviation;
    return effort;
}

} // namespace hapnet::device
