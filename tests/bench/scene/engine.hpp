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

/// A physics engine in which a scene runs: Hapnet's own, or a peer. The scene is said in Hapnet's
/// words; each adapter translates it.
class Engine {
public:
    Engine() = default;
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    virtual ~Engine() = default;

    /// Where a hand is at the start of the next step.
    virtual void set_hand(std::uint32_t index, const scene::HandInput& input) = 0;
    virtual void step() = 0;
    [[nodiscard]] virtual scene::BodyState state(scene::BodyId body) const = 0;
    /// What a hand did to the bodies in the last step, N, and to the planes that hands feel.
    [[nodiscard]] virtual glm::dvec3 hip_force(std::uint32_t index) const = 0;
};

/// How the hands' springs reach the bodies in a peer.
enum class HipForce : std::uint8_t {
    held,   // F = k depth - c v at the start of the step, as an external force: what CHAI3D does
    native, // the engine's own compliant contact
};

/// How MuJoCo integrates; the other engines have one way. Implicit suits fast spins, and Runge and
/// Kutta's fourth order flight: each takes several times as long, and has worse contacts or no
/// better ones.
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
    std::string family; // "ode": what a row calls its baseline
    bool has_native_hips = false;
    /// nullptr when it cannot run the scene.
    std::unique_ptr<Engine> (*make)(const scene::Description&, const EngineOptions&) = nullptr;
    bool has_rk4 = false; // an integrator of fourth order
};

inline constexpr const char* own_family = "hapnet";

/// Hapnet, and the peers that were found when the bench was built, Hapnet first.
[[nodiscard]] std::vector<Subject> subjects();

/// What is missing of the peers, for people; empty when nothing is.
[[nodiscard]] std::string missing_peers();

/// What the peers have said about themselves while they ran, for people; empty when nothing.
[[nodiscard]] std::string complaints_of_peers();

} // namespace hapnet::bench
