// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/requirements.hpp"
#include "scene/state.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::bench {

/// A physics engine that runs a scene: Hapnet's own, or a peer. Scenes are described in Hapnet's
/// terms, and each adapter translates them.
class Engine {
public:
    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    virtual ~Engine() = default;

    /// Sets the place of a hand at the start of the next step.
    virtual void set_hand(std::uint32_t index, const scene::HandInput& input) = 0;
    virtual void step() = 0;
    [[nodiscard]] virtual scene::BodyState state(scene::BodyId body) const = 0;
    /// Returns the force of a hand on bodies and felt planes in the last step, N.
    [[nodiscard]] virtual glm::dvec3 hip_force(std::uint32_t index) const = 0;
};

/// The way in which the hands' springs reach the bodies of a peer.
enum class HipForce : std::uint8_t {
    held,   // F = k depth - c v at the start of the step, as an external force: what CHAI3D does
    native, // the engine's own compliant contact
};

/// The integrator of MuJoCo; the other engines have one. Implicit suits fast spins, and Runge and
/// Kutta's fourth order suits flight. Each takes several times as long without better contacts.
enum class Integrator : std::uint8_t { usual, implicit, rk4 };

struct EngineOptions {
    double tick_s = 1e-3;
    bool sleeping = false;        // whether bodies at rest may fall asleep
    bool begins_asleep = false;   // peers: all but body 0 sleep from the start
    bool is_stock = false;        // peers: without the tuning for bodies of centimetres
    bool has_fast_bodies = false; // peers: with continuous collision detection where there is one
    bool has_own_planes = false;  // peers: a plane as the engine's own, also where a box is better
    HipForce hip_force = HipForce::held;
    Integrator integrator = Integrator::usual;
    std::optional<scene::StepperKind> stepper; // ours: instead of the cheapest
};

/// An engine that can be measured. In a peer the hands meet body 0 alone, which is in its favour.
struct Subject {
    std::string name;   // "ode-step"
    std::string family; // "ode": the baseline in a row
    bool has_native_hips = false;
    /// nullptr when it cannot run the scene.
    std::unique_ptr<Engine> (*make)(const scene::Description&, const EngineOptions&) = nullptr;
    bool has_rk4 = false; // an integrator of fourth order
};

inline constexpr const char* own_family = "hapnet";

/// Hapnet, and the peers that were found when the bench was built, Hapnet first.
[[nodiscard]] std::vector<Subject> subjects();

/// Returns a message about missing peers; empty when none is missing.
[[nodiscard]] std::string missing_peers();

/// Returns the peers' own errors and warnings of this run; empty when there are none.
[[nodiscard]] std::string complaints_of_peers();

} // namespace hapnet::bench
