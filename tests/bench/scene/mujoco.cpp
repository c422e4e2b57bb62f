// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// MuJoCo, which Debian builds in double precision.
#include "tests/bench/scene/peers.hpp"
#include "tests/bench/scene/penalty.hpp"

#include <cmath>
#include <cstring>
#include <iterator>
#include <mujoco/mujoco.h>
#include <numbers>
#include <spdlog/fmt/fmt.h>
#include <stdexcept>
#include <tuple>

namespace hapnet::bench {

namespace {

/// This version reserves memory for every pair of a contact and a coordinate, and has no islands
/// and no sleep: with a thousand bodies it would need gigabytes.
constexpr std::size_t bodies_at_most = 250;
constexpr std::size_t contacts_per_body = 12; // of a box in a heap; beyond that it warns
constexpr std::size_t rows_per_contact = 3;   // of its Jacobian: the normal and two tangents

long warnings = 0; // warnings of MuJoCo: contacts left out, accelerations out of range

void count_warning(const char*) { ++warnings; }

bool hear_warnings()
{
    mju_user_warning = count_warning; // MuJoCo's own handler would write a file here
    return true;
}

std::string words_of(const glm::dvec3& v)
{
    return fmt::format("{:.17g} {:.17g} {:.17g}", v.x, v.y, v.z);
}

std::string words_of(const glm::dquat& q)
{
    return fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}", q.w, q.x, q.y, q.z);
}

glm::dvec3 from_numbers(const mjtNum* v) { return {v[0], v[1], v[2]}; }

/// The reference motion of a contact, in MuJoCo's words (solref): a spring and a damper that bring
/// two bodies apart. Without restitution it is as stiff as its manual allows for the tick. MuJoCo
/// has no coefficient of restitution: an under-damped spring gives back that share of the speed.
/// The more ticks half a period takes, the more exact and the deeper the bounce.
std::string reference_of(const scene::Material& material, const EngineOptions& options)
{
    if (material.restitution <= 0.0) return fmt::format("{:.17g} 1", 2.0 * options.tick_s);
    const double ticks_of_a_bounce = options.has_fast_bodies ? 2.0 : 4.0;
    const double log_e = std::log(material.restitution);
    const double damping_ratio = -log_e / std::hypot(std::numbers::pi, log_e);
    const double damped = std::numbers::pi / (ticks_of_a_bounce * options.tick_s);
    const double frequency = damped / std::sqrt(1.0 - damping_ratio * damping_ratio);
    return fmt::format("{:.17g} {:.17g}", -frequency * frequency, -2.0 * damping_ratio * frequency);
}

/// A scene as MuJoCo reads it.
class Text {
public:
    Text(const Translation& all, const EngineOptions& options)
        : all_{all}, scene_{all.scene}, options_{options}
    {}

    [[nodiscard]] std::string write() const
    {
        // Nothing can touch where there is one body and no plane.
        const std::size_t things = scene_.bodies.size() + scene_.planes.size();
        const std::size_t contacts = things < 2 ? 1 : contacts_per_body * scene_.bodies.size();
        std::string text = fmt::format(
            "<mujoco>\n<compiler angle='radian'/>\n<size nconmax='{}' njmax='{}' nstack='{}'/>\n"
            "<option timestep='{:.17g}' gravity='{}' cone='elliptic' impratio='{}' "
            "integrator='{}'/>\n"
            "<worldbody>\n",
            contacts, rows_per_contact * contacts, stack_of(contacts), options_.tick_s,
            words_of(scene_.gravity), options_.is_stock ? 1 : 100, integrator());
        for (const auto& plane : scene_.planes) text += geometry(plane);
        for (scene::BodyId i = 0; i < scene_.bodies.size(); ++i) text += element(i);
        return text + "</worldbody>\n</mujoco>\n";
    }

private:
    [[nodiscard]] const char* integrator() const
    {
        if (options_.integrator == Integrator::usual) return "Euler";
        return options_.integrator == Integrator::rk4 ? "RK4" : "implicit";
    }

    [[nodiscard]] std::size_t stack_of(std::size_t contacts) const
    {
        const std::size_t rows = rows_per_contact * contacts, columns = 6 * scene_.bodies.size();
        // In numbers, not bytes: twice the need of its solver and its collision of many bodies.
        return 100'000 + 128 * (rows + columns) + 2 * columns * (columns + rows);
    }

    /// One friction and restitution for each thing. MuJoCo takes the greater friction of two that
    /// touch. In the scenes here both are equal.
    [[nodiscard]] std::string skin(const scene::Material& material) const
    {
        const bool is_smooth = material.friction == 0.0;
        std::string words = fmt::format("condim='{}' friction='{:.17g}'", is_smooth ? 1 : 3,
                                        std::max(material.friction, 1e-5));
        if (!options_.is_stock) {
            words += fmt::format(" solref='{}' solimp='0.99 0.9999 0.0001'",
                                 reference_of(material, options_));
        }
        return words;
    }

    [[nodiscard]] std::string geometry(const scene::PlaneDescription& plane) const
    {
        return fmt::format("<geom type='plane' size='0 0 1' zaxis='{}' pos='{}' {}/>\n",
                           words_of(plane.normal), words_of(plane.offset_m * plane.normal),
                           skin(plane.material));
    }

    /// Only free coordinates: locked ones do not exist in the model.
    [[nodiscard]] std::string joints(scene::BodyId id) const
    {
        const auto& body = scene_.bodies[id];
        const auto& locked = body.locked;
        const bool is_free =
            body.turning == scene::Turning::free && !locked.x && !locked.y && !locked.z;
        if (is_free) return "<freejoint/>";
        return fmt::format("{}{}{}", locked.x ? "" : "<joint type='slide' axis='1 0 0'/>",
                           locked.y ? "" : "<joint type='slide' axis='0 1 0'/>",
                           locked.z ? "" : "<joint type='slide' axis='0 0 1'/>");
    }

    [[nodiscard]] std::string element(const scene::BodyPart& part, double mass,
                                      const scene::Material& material) const
    {
        const Core core = core_of(part);
        glm::dquat turn = glm::quat_cast(part.axes);
        std::string kind = "box", size = words_of(part.half);
        if (part.rounding > 0.0) {
            constexpr double root = std::numbers::sqrt2 / 2.0;
            if (core.axis == 0) turn = turn * glm::dquat{root, 0.0, root, 0.0};
            if (core.axis == 1) turn = turn * glm::dquat{root, -root, 0.0, 0.0};
            kind = core.half == 0.0 ? "sphere" : "capsule";
            size = fmt::format("{:.17g} {:.17g}", part.rounding, core.half);
        }
        return fmt::format("<geom type='{}' pos='{}' quat='{}' size='{}' mass='{:.17g}' {}/>", kind,
                           words_of(part.at), words_of(turn), size, mass, skin(material));
    }

    [[nodiscard]] std::string element(scene::BodyId id) const
    {
        const auto& body = scene_.bodies[id];
        const Solid& solid = all_.solids[id];
        std::string inside = body.movable ? joints(id) : "";
        if (!solid.is_box()) {
            inside += fmt::format("<inertial pos='0 0 0' mass='{:.17g}' diaginertia='{}'/>",
                                  body.mass_kg, words_of(solid.moments));
        }
        for (const auto& part : solid.parts) inside += element(part, body.mass_kg, body.material);
        return fmt::format("<body pos='{}' quat='{}'>{}</body>\n",
                           words_of(solid.frame.centre.value), words_of(solid.frame.orientation),
                           inside);
    }

    const Translation& all_;
    const scene::Description& scene_;
    const EngineOptions& options_;
};

struct DeleteModel {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
};
struct DeleteData {
    void operator()(mjData* data) const { mj_deleteData(data); }
};
using Model = std::unique_ptr<mjModel, DeleteModel>;
using Data = std::unique_ptr<mjData, DeleteData>;

/// MuJoCo reads only files. This one is in memory.
Model compile(const std::string& text)
{
    constexpr const char* name = "scene.xml";
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(text.size()));
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), name)], text.data(), text.size());
    std::array<char, 1000> error{};
    Model model{mj_loadXML(name, files.get(), error.data(), static_cast<int>(error.size()))};
    mj_deleteVFS(files.get());
    if (!model) throw std::runtime_error{fmt::format("MuJoCo: {}", error.data())};
    return model;
}

class Mujoco final : public Engine {
public:
    Mujoco(const Translation& all, const EngineOptions& options)
        : scene_{all.scene}, hands_{all}, model_{compile(Text{all, options}.write())}
    {
        const scene::Description& scene = scene_;
        for (scene::BodyId i = 0; i < scene.bodies.size(); ++i) resist(i);
        data_ = Data{mj_makeData(model_.get())};
        for (scene::BodyId i = 0; i < scene.bodies.size(); ++i) start(i);
    }

    void set_hand(std::uint32_t index, const scene::HandInput& input) override
    {
        hands_.set(index, input);
    }

    void step() override
    {
        if (!scene_.fields.empty()) apply_fields();
        if (scene_.hands.count > 0) push();
        mj_step(model_.get(), data_.get());
    }

    [[nodiscard]] scene::BodyState state(scene::BodyId body) const override
    {
        scene::BodyState state;
        state.position = scene_.bodies[body].position;
        state.orientation = scene_.bodies[body].orientation;
        const int joints = model_->body_jntnum[id_of(body)];
        for (int i = 0; i < joints; ++i) add(state, model_->body_jntadr[id_of(body)] + i);
        return state;
    }

    [[nodiscard]] glm::dvec3 hip_force(std::uint32_t index) const override
    {
        return forces_[index];
    }

private:
    /// MuJoCo's first body is the world.
    static int id_of(scene::BodyId body) { return static_cast<int>(body) + 1; }

    [[nodiscard]] bool is_free(int joint) const { return model_->jnt_type[joint] == mjJNT_FREE; }

    /// Drag as damping of the two level coordinates, which the integrator treats implicitly.
    void resist(scene::BodyId body)
    {
        const double drag = scene_.bodies[body].drag_ns_per_m;
        if (drag == 0.0) return;
        for (int i = 0; i < model_->body_jntnum[id_of(body)]; ++i) {
            const int joint = model_->body_jntadr[id_of(body)] + i;
            mjtNum* const damping = model_->dof_damping + model_->jnt_dofadr[joint];
            if (is_free(joint)) {
                damping[0] = damping[2] = drag;
            } else if (model_->jnt_axis[3 * joint + 1] == 0.0) {
                *damping = drag;
            }
        }
    }

    void start(scene::BodyId body)
    {
        const auto& one = scene_.bodies[body];
        for (int i = 0; i < model_->body_jntnum[id_of(body)]; ++i) {
            const int joint = model_->body_jntadr[id_of(body)] + i;
            mjtNum* const rate = data_->qvel + model_->jnt_dofadr[joint];
            const glm::dvec3 v = one.velocity.value;
            if (model_->jnt_type[joint] == mjJNT_BALL) {
                const glm::dvec3 w = glm::conjugate(one.orientation) * one.angular_velocity;
                for (int axis = 0; axis < 3; ++axis) rate[axis] = w[axis];
                continue;
            }
            if (!is_free(joint)) {
                *rate = glm::dot(v, from_numbers(model_->jnt_axis + 3 * joint));
                continue;
            }
            const glm::dvec3 w = glm::conjugate(one.orientation) * one.angular_velocity;
            const std::array rates{v.x, v.y, v.z, w.x, w.y, w.z};
            std::copy(rates.begin(), rates.end(), rate);
        }
    }

    void add(scene::BodyState& state, int joint) const
    {
        const mjtNum* const place = data_->qpos + model_->jnt_qposadr[joint];
        const mjtNum* const rate = data_->qvel + model_->jnt_dofadr[joint];
        if (is_free(joint)) {
            state.position.value = from_numbers(place);
            state.orientation = {place[3], place[4], place[5], place[6]};
            state.velocity.value = from_numbers(rate);
            state.angular_velocity = state.orientation * from_numbers(rate + 3);
        } else {
            const glm::dvec3 axis = from_numbers(model_->jnt_axis + 3 * joint);
            state.position.value += *place * axis;
            state.velocity.value += *rate * axis;
        }
    }

    void apply_fields()
    {
        for (scene::BodyId i = 0; i < scene_.bodies.size(); ++i) {
            const glm::dvec3 force = force_of_fields(scene_, state(i));
            for (int axis = 0; axis < 3; ++axis)
                data_->xfrc_applied[6 * id_of(i) + axis] = force[axis];
        }
    }

    /// The hands' forces on body 0, at its centre, with their torque.
    void push()
    {
        const scene::BodyState body = state(0);
        glm::dvec3 force{0.0}, torque{0.0};
        for (std::uint32_t i = 0; i < scene_.hands.count; ++i) {
            const Load load = hands_.on_body(i, body);
            forces_[i] = load.force + hands_.on_planes(i);
            force += load.force;
            torque += glm::cross(load.point - body.position.value, load.force);
        }
        if (!scene_.fields.empty()) force += force_of_fields(scene_, body);
        const std::array wrench{force.x, force.y, force.z, torque.x, torque.y, torque.z};
        std::copy(wrench.begin(), wrench.end(), data_->xfrc_applied + 6 * id_of(0));
    }

    scene::Description scene_;
    HeldHands hands_;
    Model model_;
    Data data_;
    std::array<glm::dvec3, scene::hands_max> forces_{};
};

/// A hinge could turn a body about one axis of the world, but no scene here needs that. MuJoCo's
/// mocap bodies are not kinematic: they move, but have no velocity where they touch.
bool can_run(const scene::Description& scene)
{
    const auto is_known = [](const scene::BodyDescription& body) {
        using scene::Turning;
        if (body.kinematic) return false;
        return body.turning == Turning::free || body.turning == Turning::locked;
    };
    return scene.bodies.size() <= bodies_at_most &&
           std::all_of(scene.bodies.begin(), scene.bodies.end(), is_known);
}

} // namespace

long mujoco_complaints() { return warnings; }

std::unique_ptr<Engine> make_mujoco(const scene::Description& scene, const EngineOptions& options)
{
    static const bool is_ready = hear_warnings();
    std::ignore = is_ready;
    if (!can_run(scene)) return nullptr;
    return std::make_unique<Mujoco>(translate(scene), options);
}

} // namespace hapnet::bench
