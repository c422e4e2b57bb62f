// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/step.hpp"

#include "proto/base/ensure.hpp"
#include "scene/one_box/events.hpp"

namespace hapnet::scene {

namespace {

const BodyProperties& the_movable(const Bodies& bodies)
{
    base::ensure(bodies.movable == 1);
    return bodies.properties[0];
}

template <bool coulomb>
void arrange(Slide& slide)
{
    set_courses(slide);
    if constexpr (coulomb) with_friction(slide);
    with_bounds(slide);
}

} // namespace

template <bool coulomb>
OneBoxStepper<coulomb>::OneBoxStepper(const Description& /*description*/, const WorldConfig& config,
                                      const WorldState& state)
    : body_{the_movable(state.bodies).id},
      laws_{config.hands, the_movable(state.bodies), config.tick},
      obstacles_{config, state.bodies, the_movable(state.bodies)},
      hands_{config, state.bodies, the_movable(state.bodies)}
{
    const PerAxis mobility = per_axis(the_movable(state.bodies).inverse_mass);
    for (std::size_t i = 0; i < 3; ++i) locked_[i] = mobility[i] == 0.0;
}

template <bool coulomb>
void OneBoxStepper<coulomb>::step(const WorldConfig& config, WorldState& state)
{
    const Slot slot = state.bodies.slot_of[body_];
    Slide slide{config.hands, laws_, obstacles_};
    slide.left = config.tick;
    slide.place = per_axis(state.bodies.position.at(slot));
    slide.velocity = per_axis(state.bodies.velocity.at(slot));
    const PerAxis gravity = per_axis(config.gravity);
    for (std::size_t i = 0; i < 3; ++i) {
        if (locked_[i]) slide.velocity[i] = 0.0;
        slide.axes[i].stopped = locked_[i];
        slide.axes[i].leaving = false;
        slide.axes[i].steady = gravity[i];
    }
    if (!state.pushed.is_empty()) {
        const PerAxis push = per_axis(state.pushes[body_]);
        for (std::size_t i = 0; i < 3; ++i) slide.axes[i].steady += laws_.inverse_mass() * push[i];
    }
    see(slide, 0.0);
    if (obstacles_.put_out(slide.near, slide.place)) see(slide, 0.0);

    hands_.gather(config, state, slide);
    if (slide.grip_count == 0) {
        run(config, slide);
        conclude(config, state, slide);
    } else {
        try_holding(config, state, slide);
    }
}

template <bool coulomb>
inline void OneBoxStepper<coulomb>::see(Slide& slide, double reach)
{
    slide.near = obstacles_.near(slide.place, reach);
    slide.room = obstacles_.room(slide.place);
}

template <bool coulomb>
void OneBoxStepper<coulomb>::try_holding(const WorldConfig& config, WorldState& state, Slide& start)
{
    for (;;) { // each time a hand holds less
        Slide slide = start.copy();
        see(slide, 0.0); // what is near may have been looked for elsewhere meanwhile
        run(config, slide);
        if (SlidingHands::weaken(config, state, slide, start)) continue;
        conclude(config, state, slide);
        return;
    }
}

template <bool coulomb>
void OneBoxStepper<coulomb>::conclude(const WorldConfig& config, WorldState& state,
                                      const Slide& slide) const
{
    const Slot slot = state.bodies.slot_of[body_];
    state.bodies.position.put(slot, vector(slide.place));
    state.bodies.velocity.put(slot, vector(slide.velocity));
    SlidingHands::report(config, state, slide);
}

template <bool coulomb>
void OneBoxStepper<coulomb>::run(const WorldConfig& config, Slide& slide)
{
    arrange<coulomb>(slide);
    if (slide.slanted_count > 0) {
        SlidingHands::press_slanted(slide);
        arrange<coulomb>(slide);
    }
    for (int events = 1;; ++events) {
        const double reach =
            std::max(std::max(slide.axes[0].reach, slide.axes[1].reach), slide.axes[2].reach);
        if (!(reach <= slide.room)) see(slide, reach);
        SlideEvent event{.time = slide.left};
        if (!is_uneventful(slide)) look_for_event(slide, event);
        if constexpr (coulomb) friction_event(slide, event);
        advance(slide, event.time);
        if (event.kind == SlideEvent::Kind::none) return;
        apply(slide, event, config.tick);
        if (events == events_max) {
            slide.calm = true;
            ++crowded_ticks_;
        }
        if (slide.left <= 0.0) return;
        slide.room = obstacles_.room(slide.place);
        arrange<coulomb>(slide);
    }
}

template <bool coulomb>
void OneBoxStepper<coulomb>::on_body_placed(WorldState& /*state*/, BodyId /*body*/)
{
    hands_.forget_box();
}

template class OneBoxStepper<false>;
template class OneBoxStepper<true>;

} // namespace hapnet::scene
