// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/step.hpp"

#include "proto/base/ensure.hpp"
#include "scene/one_box/events.hpp"

namespace hapnet::scene {

namespace {

const BodyForm& the_movable(const Bodies& bodies)
{
    base::ensure(bodies.movable == 1);
    return bodies.form[0];
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
SlidingTick<coulomb>::SlidingTick(const Description& /*description*/, const Frozen& frozen,
                                  const Stage& stage)
    : body_{the_movable(stage.bodies).id},
      laws_{frozen.hips, the_movable(stage.bodies), frozen.tick},
      obstacles_{frozen, stage.bodies, the_movable(stage.bodies)},
      hands_{frozen, stage.bodies, the_movable(stage.bodies)}
{
    const PerAxis mobility = per_axis(the_movable(stage.bodies).inverse_mass);
    for (std::size_t i = 0; i < 3; ++i) locked_[i] = mobility[i] == 0.0;
}

template <bool coulomb>
void SlidingTick<coulomb>::tick(const Frozen& frozen, Stage& stage)
{
    const Slot slot = stage.bodies.slot_of[body_];
    Slide slide{frozen.hips, laws_, obstacles_};
    slide.left = frozen.tick;
    slide.place = per_axis(stage.bodies.position.at(slot));
    slide.velocity = per_axis(stage.bodies.velocity.at(slot));
    const PerAxis gravity = per_axis(frozen.gravity);
    for (std::size_t i = 0; i < 3; ++i) {
        if (locked_[i]) slide.velocity[i] = 0.0;
        slide.axes[i].stopped = locked_[i];
        slide.axes[i].leaving = false;
        slide.axes[i].steady = gravity[i];
    }
    if (!stage.pushed.is_empty()) {
        const PerAxis push = per_axis(stage.pushes[body_]);
        for (std::size_t i = 0; i < 3; ++i) slide.axes[i].steady += laws_.inverse_mass() * push[i];
    }
    see(slide, 0.0);
    if (obstacles_.put_out(slide.near, slide.place)) see(slide, 0.0);

    hands_.gather(frozen, stage, slide);
    if (slide.grip_count == 0) {
        run(frozen, slide);
        conclude(frozen, stage, slide);
    } else {
        try_holding(frozen, stage, slide);
    }
}

template <bool coulomb>
inline void SlidingTick<coulomb>::see(Slide& slide, double reach)
{
    slide.near = obstacles_.near(slide.place, reach);
    slide.room = obstacles_.room(slide.place);
}

template <bool coulomb>
void SlidingTick<coulomb>::try_holding(const Frozen& frozen, Stage& stage, Slide& start)
{
    for (;;) { // each time a hand holds less
        Slide slide = start.copy();
        see(slide, 0.0); // what is near may have been looked for elsewhere meanwhile
        run(frozen, slide);
        if (SlidingHands::weaken(frozen, stage, slide, start)) continue;
        conclude(frozen, stage, slide);
        return;
    }
}

template <bool coulomb>
void SlidingTick<coulomb>::conclude(const Frozen& frozen, Stage& stage, const Slide& slide) const
{
    const Slot slot = stage.bodies.slot_of[body_];
    stage.bodies.position.put(slot, vector(slide.place));
    stage.bodies.velocity.put(slot, vector(slide.velocity));
    SlidingHands::report(frozen, stage, slide);
}

template <bool coulomb>
void SlidingTick<coulomb>::run(const Frozen& frozen, Slide& slide)
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
        apply(slide, event, frozen.tick);
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
void SlidingTick<coulomb>::disturbed(Stage& /*stage*/, BodyId /*body*/)
{
    hands_.forget_box();
}

template class SlidingTick<false>;
template class SlidingTick<true>;

} // namespace hapnet::scene
