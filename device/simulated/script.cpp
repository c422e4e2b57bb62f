// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/script.hpp"

#include "device/simulated/carriage.hpp"
#include "device/simulated/minimum_jerk.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::device {

namespace {

// The geometry of the scene for the hand: the HIP touches the cube's face 25 mm from its centre.
constexpr double touching_m = 0.025;
constexpr double clear_m = 0.055; // x from the cube's centre, on the way to the part

// The distance from the cube at which a hand waits before it approaches; in T1, that of the idle
// hand.
constexpr double clearance_m = 0.008;
// The distance to which the hand approaches before it presses gently. A cube that two hands touch
// yields without resistance while their forces are in transit.
constexpr double near_m = 0.001;
constexpr double near_after_s = 0.5;
constexpr double pressing_after_s = 2.0;

constexpr double watching_x_m = 0.105; // where the hand that watches stays in P1

// T9 and T10 have work for one hand on each side. A third and further ones watch.
constexpr double watching_y_m = 0.050;
constexpr double watching_z_m = -0.030;

// T1: the path speed over which the turn changes.
constexpr double turn_speed_m_per_s = 0.020;

// The stiffness of the contact between a finger and the cube.
constexpr double contact_n_per_m = 500.0;

// T3: the force of a nominal hand that aims 4 mm inside; the mean stays below 0.8 N.
constexpr double carry_squeeze_n = 4.0 / 7.0;

// T4: the friction between finger and cube at 0.86 N of squeeze carries twice the cube's 0.5 N. The
// aim is a little higher than the cube should go, because the hands yield by that distance.
constexpr double lift_aim_m = 0.0525;
constexpr double lift_begins_s = 6.0; // by then the hands have made up for delayed forces
constexpr double lift_takes_s = 2.0;
constexpr double lift_holds_s = 5.0;

// T5: the cube is next to the static one, and both hands press its left face, side by side.
constexpr double wall_apart_m = 0.006; // distance of each hand from the face's middle, along z
constexpr double wall_lets_go_s = 5.0; // B lets go; then every 5 s one hand, A and B in turn
constexpr double wall_every_s = 5.0;
constexpr int wall_rounds = 2;
constexpr double wall_back_off_m = 0.020;
constexpr double wall_back_off_takes_s = 0.05;
constexpr double wall_away_s = 2.0;
constexpr double wall_returns_s = 1.0;

// T6: the tapping hand oscillates about a point off the face, so that it hits the face on its way
// in.
constexpr double taps_begin_s = 2.0;
constexpr double tap_hertz = 3.0;
constexpr double tap_amplitude_m = 0.013;
constexpr double tap_off_m = 0.004;

// T8: the distance from the cube's middle at which a hand presses. When the hand turns the cube in
// the other direction, it presses on the other side of the middle.
constexpr double turn_beside_m = 0.010;
constexpr double turn_angle_rad = 0.5; // rotation of the cube each way
constexpr double turn_squeeze_n = 0.7;
constexpr double turn_every_s = 6.0; // each turn; the three times below lie within it
constexpr double turn_closes_s = 1.0;
constexpr double turn_turned_s = 4.0;
constexpr double turn_opened_s = 5.0; // then the hand goes over to the other side

constexpr double let_go_m = 0.020;
constexpr double lift_off_m = 0.045; // clear of the cube, whose upper face is at 20 mm
constexpr double let_go_s = 0.5;

double path_speed(double seconds)
{
    constexpr double half_step = 0.005;
    return (path_x(seconds + half_step) - path_x(seconds - half_step)) / (2.0 * half_step);
}

double sine_of_turns(double turns)
{
    std::array<double, 1> sine{turns};
    base::sines_of_turns(sine);
    return sine[0];
}

/// Returns a smooth transition from 0 to 1 between two times.
double between(double begin, double end, double t)
{
    return minimum_jerk((t - begin) / (end - begin));
}

/// Returns the depth within the cube's face of the aim of a hand that approaches from the start on.
double closing(double squeeze, double t)
{
    return -clearance_m + (clearance_m - near_m) * between(0.0, near_after_s, t) +
           (near_m + squeeze) * between(near_after_s, pressing_after_s, t);
}

Intention at_x(double x, bool searching = false)
{
    return {.target = {{x, 0.0, 0.0}}, .searching = searching};
}

} // namespace

Script::Script(Task task, const Cue& cue, const TaskOptions& options, const HandImpedance& hand)
    : task_{task},
      cue_{cue},
      options_{options},
      presses_{press_schedule_of(options)},
      side_{cue.is_left ? -1.0 : 1.0},
      depth_m_per_n_{1.0 / hand.stiffness_n_per_m + 1.0 / contact_n_per_m}
{
    // In T5 both hands are left of the cube.
    if (task == Task::t5) side_ = -1.0;
}

double Script::aside_x() const { return side_ * clear_m; }

double Script::pressing_toward() const { return -side_; }

double Script::squeeze_n() const
{
    if (options_.squeeze_n) return *options_.squeeze_n;
    switch (task_) {
    case Task::t3:
    case Task::t7: return carry_squeeze_n;
    case Task::t4: return 0.86;
    case Task::t5: return 0.71;
    case Task::t6: return 0.14;
    case Task::t8: return turn_squeeze_n;
    default: return 0.0;
    }
}

double Script::depth_m(double force_n) const { return force_n * depth_m_per_n_; }

Intention Script::at(base::TimePoint now) const
{
    const double t = base::to_seconds(now - cue_.start);
    const double hands_on = base::to_seconds(cue_.hands_on);
    Intention intention = working(std::clamp(t, 0.0, hands_on));
    if (t < 0.0 || t >= hands_on) intention.gripping = intention.searching = false;
    if (t < hands_on) return intention;
    // The hand moves up and aside. After an outage the two copies may be apart, so that aside alone
    // might not release the cube.
    const double gone = minimum_jerk((t - hands_on) / let_go_s);
    intention.target.value += glm::dvec3{side_ * let_go_m * gone, lift_off_m * gone, 0.0};
    intention.pressing_n.reset();
    intention.searching = false;
    return intention;
}

Intention Script::working(double t) const
{
    if (way_) {
        const HandMoment moment = moment_at(*way_, t);
        return {.target = moment.hip, .gripping = moment.gripping};
    }
    switch (task_) {
    case Task::p1: {
        if (cue_.is_left) {
            Intention intention = at_x(path_x(t) - touching_m);
            intention.gripping = true;
            return intention;
        }
        // The watching hand stays out of the path of the carried cube, even of one that a
        // prediction carries through the static cube.
        Intention intention = at_x(watching_x_m);
        intention.target.value.y = lift_off_m;
        return intention;
    }
    case Task::t1: return at_x(turn_x(t), turn_share(t) >= 1.0);
    case Task::t2: return at_x(press_x(t), t >= pressing_after_s);
    case Task::t3:
    case Task::t7: return at_x(carry_x(t), true);
    case Task::t4: return lift(t);
    case Task::t5: return wall(t);
    case Task::t6: return at_x(tap_x(t));
    case Task::t8: return turn(t);
    case Task::t9:
        if (!cue_.is_first) return watch();
        return carried(cue_.is_left ? left_of_tower : right_of_tower, t);
    case Task::t10:
        if (!cue_.is_first) return watch();
        return carried(cue_.is_left ? giver : taker, t);
    }
    return {};
}

double Script::turn_share(double t) const
{
    const double rising = std::clamp(0.5 + path_speed(t) / (2.0 * turn_speed_m_per_s), 0.0, 1.0);
    return cue_.is_left ? rising : 1.0 - rising;
}

double Script::turn_x(double t) const
{
    return path_x(t) + side_ * (touching_m + clearance_m * (1.0 - turn_share(t)));
}

double Script::press_x(double t) const
{
    double depth = closing(options_.press_depth_m, t);
    for (const PressInterval& press : presses_) {
        if (press.left_presses != cue_.is_left || t < press.begin_s || t >= press.end_s) continue;
        depth += options_.press_amplitude_m * sine_of_turns(press.hertz * (t - press.begin_s));
    }
    return side_ * (touching_m - depth);
}

double Script::carry_x(double t) const
{
    const double lag = cue_.is_left ? 0.0 : base::to_seconds(options_.follower_lag);
    return path_x(options_.pace * (t - lag)) +
           side_ * (touching_m - depth_m(cue_.share * squeeze_n()));
}

Intention Script::lift(double t) const
{
    const double squeeze = depth_m(squeeze_n());
    constexpr double up = lift_begins_s + lift_takes_s;
    constexpr double down = up + lift_holds_s;
    constexpr double lowered = down + lift_takes_s;
    constexpr double opens = lowered + 0.5; // the cube stands again and has settled
    const double opened = between(opens, opens + 1.0, t);
    const double depth = closing(squeeze, t) - opened * (clearance_m + squeeze);
    Intention intention = at_x(side_ * (touching_m - depth));
    intention.target.value.y =
        lift_aim_m * (between(lift_begins_s, up, t) - between(down, lowered, t));
    if (t >= pressing_after_s && t < opens) intention.pressing_n = squeeze_n();
    return intention;
}

Intention Script::wall(double t) const
{
    const double squeeze = depth_m(squeeze_n());
    double depth = closing(squeeze, t);
    bool presses = t >= pressing_after_s;
    // B lets go first.
    double go = wall_lets_go_s + (cue_.is_left ? wall_every_s : 0.0);
    for (int round = 0; round < wall_rounds; ++round, go += 2.0 * wall_every_s) {
        const double back = go + wall_away_s;
        depth -= wall_back_off_m * (between(go, go + wall_back_off_takes_s, t) -
                                    between(back, back + wall_returns_s, t));
        if (t >= go && t < back + wall_returns_s) presses = false;
    }
    Intention intention = at_x(-touching_m + depth);
    intention.target.value.z = cue_.is_left ? -wall_apart_m : wall_apart_m;
    if (presses) intention.pressing_n = squeeze_n();
    return intention;
}

double Script::tap_x(double t) const
{
    if (!cue_.is_left) return touching_m - closing(depth_m(squeeze_n()), t);
    const double swing = t < taps_begin_s ? 0.0 : sine_of_turns(tap_hertz * (t - taps_begin_s));
    return -touching_m - tap_off_m + tap_amplitude_m * swing;
}

/// Returns an intention above and behind the objects that the others carry.
Intention Script::watch() const
{
    return {.target = {{side_ * clear_m, watching_y_m, watching_z_m}}};
}

/// Returns the intention in T8: the cube turns about the vertical with the hands, in one direction
/// in even turns, and back in odd ones.
Intention Script::turn(double t) const
{
    const double number = std::floor(t / turn_every_s);
    const double within = t - number * turn_every_s;
    const bool is_back = std::fmod(number, 2.0) != 0.0;
    const double turned = between(turn_closes_s, turn_turned_s, within);
    const double angle = turn_angle_rad * (is_back ? 1.0 - turned : turned);
    const double closed =
        between(0.0, turn_closes_s, within) - between(turn_turned_s, turn_opened_s, within);
    const double depth = -clearance_m + closed * (clearance_m + depth_m(cue_.share * squeeze_n()));
    const double over = between(turn_opened_s, turn_every_s, within);
    const double beside = turn_beside_m * (is_back ? -1.0 : 1.0) * (1.0 - 2.0 * over);
    const double x = side_ * (touching_m - depth);
    const double z = -side_ * beside;
    const double cosine = base::cos(angle);
    const double sine = base::sin(angle);
    return {.target = {{cosine * x + sine * z, 0.0, cosine * z - sine * x}}};
}

} // namespace hapnet::device
