// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/engine.hpp"
#include "tests/bench/scene/translation.hpp"

namespace hapnet::bench {

/// Hapnet's own scene.
[[nodiscard]] std::unique_ptr<Engine> make_hapnet(const scene::Description& scene,
                                                  const EngineOptions& options);

/// Returns how often Hapnet's guards discarded motion, in all engines that have ended.
[[nodiscard]] std::uint64_t hapnet_guards();

/// ODE with dWorldQuickStep (iterative) and dWorldStep (direct); defined when it was found.
[[nodiscard]] std::unique_ptr<Engine> make_ode_quick(const scene::Description& scene,
                                                     const EngineOptions& options);
[[nodiscard]] std::unique_ptr<Engine> make_ode_step(const scene::Description& scene,
                                                    const EngineOptions& options);
/// Returns the number of internal errors that ODE's direct solver reported.
[[nodiscard]] long ode_complaints();

/// MuJoCo; defined when it was found.
[[nodiscard]] std::unique_ptr<Engine> make_mujoco(const scene::Description& scene,
                                                  const EngineOptions& options);
/// Returns the number of MuJoCo's warnings, such as contacts that it had to leave out.
[[nodiscard]] long mujoco_complaints();

/// Bullet in single and in double precision. Both give their functions the same names, so each is a
/// module that is loaded into a namespace of its own.
[[nodiscard]] std::unique_ptr<Engine> make_bullet(const scene::Description& scene,
                                                  const EngineOptions& options);
[[nodiscard]] std::unique_ptr<Engine> make_bullet_double(const scene::Description& scene,
                                                         const EngineOptions& options);

/// The function that a module of Bullet exports.
using MakeEngine = Engine*(const Translation*, const EngineOptions*);
inline constexpr const char* make_engine_symbol = "hapnet_bench_make_engine";

} // namespace hapnet::bench
