// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/peers.hpp"

#include <dlfcn.h>
#include <spdlog/fmt/fmt.h>
#include <stdexcept>

namespace hapnet::bench {

namespace {

#ifdef HAPNET_BENCH_BULLET
/// Loads the module into a namespace of its own, and never unloads it.
MakeEngine* load(const char* path)
{
    void* const module = dlmopen(LM_ID_NEWLM, path, RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) throw std::runtime_error{dlerror()};
    void* const symbol = dlsym(module, make_engine_symbol);
    if (symbol == nullptr) throw std::runtime_error{dlerror()};
    return reinterpret_cast<MakeEngine*>(symbol);
}

std::unique_ptr<Engine> make_translated(MakeEngine* make, const scene::Description& scene,
                                        const EngineOptions& options)
{
    const Translation all = translate(scene);
    return std::unique_ptr<Engine>{make(&all, &options)};
}
#endif

} // namespace

#ifdef HAPNET_BENCH_BULLET
std::unique_ptr<Engine> make_bullet(const scene::Description& scene, const EngineOptions& options)
{
    static MakeEngine* const make = load(HAPNET_BENCH_BULLET);
    return make_translated(make, scene, options);
}

std::unique_ptr<Engine> make_bullet_double(const scene::Description& scene,
                                           const EngineOptions& options)
{
    static MakeEngine* const make = load(HAPNET_BENCH_BULLET_DOUBLE);
    return make_translated(make, scene, options);
}
#endif

Translation translate(const scene::Description& scene)
{
    Translation all{scene, {}, {}};
    for (const auto& body : scene.bodies) {
        all.solids.push_back(
            {scene::frame_of_mass(body), scene::inertia_of(body), scene::parts_of(body)});
    }
    if (!scene.bodies.empty()) {
        const auto& body = scene.bodies[0];
        all.hand_friction = combined(friction_of(scene.hands, scene::Feel{}),
                                     friction_of(body.material, body.feel));
    }
    return all;
}

std::vector<Subject> subjects()
{
    std::vector<Subject> all{{"hapnet", own_family, false, make_hapnet}};
#ifdef HAPNET_BENCH_BULLET
    all.push_back({"bullet", "bullet", true, make_bullet});
    all.push_back({"bullet-double", "bullet", true, make_bullet_double});
#endif
#ifdef HAPNET_BENCH_ODE
    all.push_back({"ode-quick", "ode", true, make_ode_quick});
    all.push_back({"ode-step", "ode", true, make_ode_step});
#endif
#ifdef HAPNET_BENCH_MUJOCO
    all.push_back({"mujoco", "mujoco", false, make_mujoco, true});
#endif
    return all;
}

std::string missing_peers()
{
    std::string missing;
#ifndef HAPNET_BENCH_BULLET
    missing += " Bullet (libbullet-dev)";
#endif
#ifndef HAPNET_BENCH_ODE
    missing += " ODE (libode-dev)";
#endif
#ifndef HAPNET_BENCH_MUJOCO
    missing += " MuJoCo (libmujoco-dev)";
#endif
    return missing.empty() ? "" : "built without" + missing + ": its rows are left out";
}

std::string complaints_of_peers()
{
    std::vector<std::string> said;
#ifdef HAPNET_BENCH_ODE
    if (const long count = ode_complaints(); count > 0) {
        said.push_back(fmt::format("ODE: {} internal errors of its direct solver", count));
    }
#endif
#ifdef HAPNET_BENCH_MUJOCO
    if (const long count = mujoco_complaints(); count > 0) {
        said.push_back(fmt::format("MuJoCo: {} warnings", count));
    }
#endif
    return said.empty() ? "" : fmt::format("errors of peers: {}", fmt::join(said, "; "));
}

} // namespace hapnet::bench
