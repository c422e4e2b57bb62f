// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/wire/message.hpp"

#include "proto/base/bytes.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/nearest.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>

namespace hapnet::wire {

namespace {

using base::ByteReader;
using base::ByteWriter;
using base::fail;
using base::Result;

constexpr std::uint16_t magic = 0x4e48; // "HN"
enum Type : std::uint8_t { type_hello = 1, type_state = 2, type_bye = 3 };

constexpr std::uint8_t flag_echo = 1U << 0;
// Flags of a hello.
constexpr std::uint8_t flag_start = 1U << 1;
constexpr std::uint8_t flag_start_heard = 1U << 2;
constexpr std::uint8_t flag_in_session = 1U << 3;
// Flags of a state.
constexpr std::uint8_t flag_touching = 1U << 1;
constexpr std::uint8_t flag_holding = 1U << 2;
constexpr std::uint8_t flag_body = 1U << 3;
constexpr std::uint8_t flags_known = 0x0f;

constexpr auto echo_age_max = base::Duration{std::numeric_limits<std::uint32_t>::max()};

std::uint8_t flag_if(bool condition, std::uint8_t flag) { return condition ? flag : 0; }

inline void put_header(ByteWriter& out, Type type, std::uint32_t session)
{
    out.u16(magic);
    out.u8(protocol_version);
    out.u8(type);
    out.u32(session);
}

/// No clock is farther from its zero than 36 years. Larger times are refused, so that the
/// difference of any two times is within range.
constexpr std::int64_t time_max_ns = std::int64_t{1} << 60;

bool is_near(std::int64_t ns) { return ns >= -time_max_ns && ns <= time_max_ns; }

inline void put_time(ByteWriter& out, base::TimePoint time)
{
    const std::int64_t nanoseconds = time.time_since_epoch().count();
    base::ensure(is_near(nanoseconds));
    out.i64(nanoseconds);
}

inline base::TimePoint take_time(ByteReader& in, bool& canonical)
{
    const std::int64_t nanoseconds = in.i64();
    canonical = canonical && is_near(nanoseconds);
    return base::TimePoint{base::Duration{nanoseconds}};
}

using Words = std::array<std::uint32_t, 3>; // three single-precision numbers, or three sums

/// Writes three words together, so that the room is checked once and not three times.
inline void put_words(ByteWriter& out, const Words& words)
{
    const Words ordered{base::in_little_endian(words[0]), base::in_little_endian(words[1]),
                        base::in_little_endian(words[2])};
    out.raw(std::as_bytes(std::span{ordered}));
}

/// Reads three words. They are zero if there are too few bytes.
inline Words take_words(ByteReader& in)
{
    Words words{};
    const auto bytes = in.raw(sizeof(Words));
    if (bytes.empty()) return words;
    std::memcpy(words.data(), bytes.data(), sizeof(Words));
    return {base::in_little_endian(words[0]), base::in_little_endian(words[1]),
            base::in_little_endian(words[2])};
}

inline void put_vector(ByteWriter& out, const glm::dvec3& v)
{
    constexpr double most = std::numeric_limits<float>::max();
    base::ensure(std::abs(v.x) <= most && std::abs(v.y) <= most && std::abs(v.z) <= most);
    const auto word = [](double component) {
        return std::bit_cast<std::uint32_t>(static_cast<float>(component));
    };
    put_words(out, {word(v.x), word(v.y), word(v.z)});
}

inline glm::dvec3 take_vector(ByteReader& in)
{
    const Words words = take_words(in);
    const auto component = [](std::uint32_t word) {
        return static_cast<double>(std::bit_cast<float>(word));
    };
    return {component(words[0]), component(words[1]), component(words[2])};
}

/// Writes an echo. Optional fields always have the same length; absent ones are all zero.
inline void put_echo(ByteWriter& out, const std::optional<Echo>& echo)
{
    base::ensure(!echo || (echo->age >= base::Duration{0} && echo->age <= echo_age_max));
    put_time(out, echo ? echo->of : base::TimePoint{});
    out.u32(echo ? static_cast<std::uint32_t>(echo->age.count()) : 0);
}

/// Returns nullopt when absent; `canonical` becomes false when an absent field is not all zero.
inline std::optional<Echo> take_echo(ByteReader& in, bool present, bool& canonical)
{
    const Echo echo{take_time(in, canonical), base::Duration{in.u32()}};
    if (present) return echo;
    canonical = canonical && echo == Echo{};
    return std::nullopt;
}

std::optional<base::TimePoint> take_optional_time(ByteReader& in, bool present, bool& canonical)
{
    const base::TimePoint time = take_time(in, canonical);
    if (present) return time;
    canonical = canonical && time == base::TimePoint{};
    return std::nullopt;
}

constexpr std::uint32_t ids_known = ~std::uint32_t{1}; // bits of the ids 1 to 31

bool is_canonical(const HandModel& hand)
{
    const auto is_size = [](float value) { return std::isfinite(value) && !std::signbit(value); };
    return is_size(hand.mass) && is_size(hand.damping) && is_size(hand.stiffness) &&
           is_size(hand.friction);
}

void put(ByteWriter& out, const Hello& hello)
{
    base::ensure(hello.nonce != 0 && hello.peer_id != 0);
    put_header(out, type_hello, 0);
    const int flags = flag_if(hello.echo.has_value(), flag_echo) |
                      flag_if(hello.start.has_value(), flag_start) |
                      flag_if(hello.start_heard.has_value(), flag_start_heard) |
                      flag_if(hello.in_session, flag_in_session);
    out.u8(static_cast<std::uint8_t>(flags));
    out.u32(hello.nonce);
    out.u32(hello.nonce_heard);
    out.u16(hello.peer_id);
    out.u16(hello.tick_rate_hz);
    out.u64(hello.scene_hash);
    out.u64(hello.seed);
    put_time(out, hello.sent);
    put_echo(out, hello.echo);
    put_time(out, hello.start.value_or(base::TimePoint{}));
    put_time(out, hello.start_heard.value_or(base::TimePoint{}));
    const auto task = hello.task.text();
    base::ensure(!task.empty());
    out.raw(std::as_bytes(std::span{task}));
    for (auto i = task.size(); i < TaskName::bytes_max; ++i) out.u8(0);
    base::ensure(is_canonical(hello.hand) && (hello.heard & ~ids_known) == 0);
    out.u32(hello.length_ms);
    out.u32(hello.heard);
    out.u32(hello.boot);
    out.f32(hello.hand.mass);
    out.f32(hello.hand.damping);
    out.f32(hello.hand.stiffness);
    out.f32(hello.hand.friction);
}

/// A description of the error in a message; nullptr if there is none.
using Fault = const char*;

Fault take(ByteReader& in, Hello& hello)
{
    bool canonical = in.u32() == 0; // a hello has no session number
    const std::uint8_t flags = in.u8();
    hello.nonce = in.u32();
    hello.nonce_heard = in.u32();
    hello.peer_id = in.u16();
    hello.tick_rate_hz = in.u16();
    hello.scene_hash = in.u64();
    hello.seed = in.u64();
    hello.sent = take_time(in, canonical);
    hello.echo = take_echo(in, (flags & flag_echo) != 0, canonical);
    hello.start = take_optional_time(in, (flags & flag_start) != 0, canonical);
    hello.start_heard = take_optional_time(in, (flags & flag_start_heard) != 0, canonical);
    hello.in_session = (flags & flag_in_session) != 0;
    const auto name = in.raw(TaskName::bytes_max);
    hello.length_ms = in.u32();
    hello.heard = in.u32();
    hello.boot = in.u32();
    hello.hand = {
        .mass = in.f32(), .damping = in.f32(), .stiffness = in.f32(), .friction = in.f32()};
    if (!in.complete()) return "hello: wrong length";
    canonical = canonical && is_canonical(hello.hand) && (hello.heard & ~ids_known) == 0;
    const auto end = std::find(name.begin(), name.end(), std::byte{0});
    canonical =
        canonical && std::all_of(end, name.end(), [](std::byte b) { return b == std::byte{0}; });
    std::string text;
    std::transform(name.begin(), end, std::back_inserter(text),
                   [](std::byte b) { return static_cast<char>(b); });
    const auto task = TaskName::from_text(text);
    canonical = canonical && hello.nonce != 0 && hello.peer_id != 0;
    if (!task || (flags & ~flags_known) != 0 || !canonical) {
        return "hello: not canonical";
    }
    hello.task = *task;
    return nullptr;
}

constexpr std::uint16_t flag_turning = 0x8000;
static_assert((BodyState::id_max & flag_turning) == 0);

inline void put(ByteWriter& out, const BodyState& body)
{
    base::ensure(body.body <= BodyState::id_max);
    const std::uint16_t turning = body.turning ? flag_turning : 0;
    out.u16(static_cast<std::uint16_t>(body.body | turning));
    put_vector(out, body.position.value);
    put_vector(out, body.velocity.value);
    put_words(out, body.caused_displacement_um);
    put_words(out, body.caused_impulse_uns);
    if (!body.turning) return;
    out.u64(body.turning->orientation.code());
    put_vector(out, body.turning->angular_velocity);
    put_words(out, body.turning->caused_rotation_urad);
    put_words(out, body.turning->caused_angular_impulse_unms);
}

/// Reads a body. `id` was read before.
inline BodyState take_body(ByteReader& in, std::uint16_t id, bool& canonical)
{
    BodyState body{.body = static_cast<std::uint16_t>(id & ~flag_turning),
                   .position = {take_vector(in)},
                   .velocity = {take_vector(in)},
                   .caused_displacement_um = take_words(in),
                   .caused_impulse_uns = take_words(in),
                   .turning = {}};
    if ((id & flag_turning) == 0) return body;
    Turning& turning = body.turning.emplace();
    const auto orientation = Orientation::from_code(in.u64());
    canonical = canonical && orientation.has_value();
    turning.orientation = orientation.value_or(Orientation{});
    turning.angular_velocity = take_vector(in);
    turning.caused_rotation_urad = take_words(in);
    turning.caused_angular_impulse_unms = take_words(in);
    return body;
}

// The resolution of an intention, in metres and metres per second.
constexpr double intention_step = 1e-5, intention_velocity_step = 2e-4;
constexpr std::int16_t steps_max = 0x7fff;

inline void put_steps(ByteWriter& out, const glm::dvec3& v, double step)
{
    base::ensure(base::is_finite(v));
    for (const double component : {v.x, v.y, v.z}) {
        const double limit = steps_max;
        const double bounded = std::min(limit, std::max(-limit, component / step));
        out.u16(static_cast<std::uint16_t>(base::nearest_in_range(bounded)));
    }
}

inline glm::dvec3 take_steps(ByteReader& in, double step, bool& canonical)
{
    glm::dvec3 v{0.0};
    for (glm::length_t i = 0; i < 3; ++i) {
        const auto steps = static_cast<std::int16_t>(in.u16());
        canonical = canonical && steps >= -steps_max;
        v[i] = step * steps;
    }
    return v;
}

inline void put(ByteWriter& out, const State& state)
{
    base::ensure(state.sequence != 0);
    base::ensure(state.touching || !state.holding);
    put_header(out, type_state, state.session);
    out.u32(state.sequence);
    put_time(out, state.sent);
    const int flags =
        flag_if(state.echo.has_value(), flag_echo) | flag_if(state.touching, flag_touching) |
        flag_if(state.holding, flag_holding) | flag_if(!state.bodies.empty(), flag_body);
    out.u8(static_cast<std::uint8_t>(flags));
    out.u8(0); // reserved
    put_echo(out, state.echo);
    put_vector(out, state.hip.value);
    put_vector(out, state.hip_velocity.value);
    put_vector(out, state.contact_force.value);
    put_steps(out, state.intention.value, intention_step);
    put_steps(out, state.intention_velocity.value, intention_velocity_step);
    out.u32(state.work_uj);
    for (const BodyState& body : state.bodies) put(out, body);
}

inline bool is_finite(const BodyState& body)
{
    return base::is_finite(body.position) && base::is_finite(body.velocity) &&
           (!body.turning || base::is_finite(base::Velocity{body.turning->angular_velocity}));
}

inline bool is_finite(const State& state)
{
    const auto& bodies = state.bodies;
    return base::is_finite(state.hip) && base::is_finite(state.hip_velocity) &&
           base::is_finite(state.contact_force) &&
           std::all_of(bodies.begin(), bodies.end(),
                       [](const BodyState& body) { return is_finite(body); });
}

// The number of bytes of every state after its type, and of each body.
constexpr std::size_t head_bytes = 82, body_bytes = 50;
constexpr std::size_t turning_bytes = 44; // further bytes of a body that can turn

Fault take(ByteReader& in, State& state)
{
    // This is checked first, so that the reads below need no check.
    if (!in.holds(head_bytes)) return "state: wrong length";
    bool canonical = true;
    state.session = in.u32();
    state.sequence = in.u32();
    state.sent = take_time(in, canonical);
    const std::uint8_t flags = in.u8();
    const std::uint8_t reserved = in.u8();
    state.echo = take_echo(in, (flags & flag_echo) != 0, canonical);
    state.touching = (flags & flag_touching) != 0;
    state.holding = (flags & flag_holding) != 0;
    state.hip = {take_vector(in)};
    state.hip_velocity = {take_vector(in)};
    state.contact_force = {take_vector(in)};
    state.intention = {take_steps(in, intention_step, canonical)};
    state.intention_velocity = {take_steps(in, intention_velocity_step, canonical)};
    state.work_uj = in.u32();
    while (!in.complete()) {
        const bool fits = in.holds(body_bytes) && state.bodies.size() < bodies_max;
        if (!fits) return "state: wrong length";
        const std::uint16_t id = in.u16();
        const bool turns = (id & flag_turning) != 0;
        if (turns && !in.holds(body_bytes - sizeof id + turning_bytes))
            return "state: wrong length";
        const bool ascends =
            state.bodies.empty() || (state.bodies.end() - 1)->body < (id & ~flag_turning);
        if (!ascends) return "state: not canonical";
        state.bodies.add([&] { return take_body(in, id, canonical); });
    }
    canonical = canonical && ((flags & flag_body) != 0) == !state.bodies.empty();
    if (!is_finite(state)) return "state: not finite";
    if (state.sequence == 0 || reserved != 0 || (flags & ~flags_known) != 0 || !canonical ||
        (state.holding && !state.touching)) {
        return "state: not canonical";
    }
    return nullptr;
}

void put(ByteWriter& out, const Bye& bye)
{
    put_header(out, type_bye, bye.session);
    out.u8(static_cast<std::uint8_t>(bye.reason));
}

Fault take(ByteReader& in, Bye& bye)
{
    bye.session = in.u32();
    const std::uint8_t reason = in.u8();
    if (!in.complete()) return "bye: wrong length";
    if (reason >= bye_reasons) return "bye: unknown reason";
    bye.reason = static_cast<ByeReason>(reason);
    return nullptr;
}

/// Decodes a message directly into its result, because states are long and arrive a thousand times
/// a second.
template <typename Kind>
[[gnu::flatten]] Result<Message> taken(ByteReader in)
{
    Result<Message> result{tl::in_place, std::in_place_type<Kind>};
    if (const Fault fault = take(in, *std::get_if<Kind>(&*result))) result = fail(fault);
    return result;
}

} // namespace

std::uint32_t session_number(std::uint32_t low_nonce, std::uint32_t high_nonce)
{
    std::uint64_t mixed = (static_cast<std::uint64_t>(low_nonce) << 32 | high_nonce);
    mixed ^= mixed >> 31; // the finalizer of SplitMix64 (Steele, Lea, Flood 2014)
    mixed *= 0xbf58476d1ce4e5b9U;
    mixed ^= mixed >> 27;
    mixed *= 0x94d049bb133111ebU;
    const auto number = static_cast<std::uint32_t>(mixed >> 32);
    return number == 0 ? 1 : number;
}

/// Computes FNV-1a, folded to 32 bits.
std::uint32_t boot_of(std::string_view boot_id)
{
    if (boot_id.empty()) return 0;
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : boot_id) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3U;
    }
    const auto folded = static_cast<std::uint32_t>(hash ^ hash >> 32);
    return folded == 0 ? 1 : folded;
}

std::optional<TaskName> TaskName::from_text(std::string_view text)
{
    const auto is_printable = [](char c) { return c > ' ' && c <= '~'; };
    if (text.empty() || text.size() > bytes_max) return std::nullopt;
    if (!std::all_of(text.begin(), text.end(), is_printable)) return std::nullopt;
    TaskName name;
    std::copy(text.begin(), text.end(), name.characters_.begin());
    return name;
}

std::string_view TaskName::text() const
{
    const auto end = std::find(characters_.begin(), characters_.end(), '\0');
    return {characters_.data(), static_cast<std::size_t>(end - characters_.begin())};
}

namespace {

constexpr unsigned component_bits = 20;
constexpr std::uint64_t component_mask = (std::uint64_t{1} << component_bits) - 1;
constexpr std::uint64_t zero_component = std::uint64_t{1} << (component_bits - 1);
// The three smaller components are at most 1/sqrt(2) in size.
constexpr double component_step = 0.70710678118654752440 / static_cast<double>(zero_component - 1);

struct SmallestThree {
    std::array<double, 3> small{};
    double largest_square = 1.0;
};
SmallestThree smallest_three(std::uint64_t code)
{
    SmallestThree result;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::uint64_t field = code >> (component_bits * i) & component_mask;
        const auto steps =
            static_cast<std::int64_t>(field) - static_cast<std::int64_t>(zero_component);
        result.small[i] = component_step * static_cast<double>(steps);
        result.largest_square -= result.small[i] * result.small[i];
    }
    return result;
}

} // namespace

Orientation Orientation::from(const glm::dquat& orientation)
{
    const double size = std::sqrt(glm::dot(orientation, orientation));
    base::ensure(std::abs(size - 1.0) < 1e-3);
    const std::array<double, 4> components{orientation.w / size, orientation.x / size,
                                           orientation.y / size, orientation.z / size};
    std::size_t largest = 0;
    for (std::size_t i = 1; i < 4; ++i) {
        if (std::abs(components[i]) > std::abs(components[largest])) largest = i;
    }
    const double sign = components[largest] < 0.0 ? -1.0 : 1.0; // q and -q are the same orientation
    std::uint64_t code = std::uint64_t{largest} << (3 * component_bits);
    unsigned place = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        if (i == largest) continue;
        const auto steps = std::llround(sign * components[i] / component_step);
        code |= (static_cast<std::uint64_t>(steps + static_cast<long long>(zero_component)) &
                 component_mask)
                << (component_bits * place++);
    }
    return Orientation{code};
}

std::optional<Orientation> Orientation::from_code(std::uint64_t code)
{
    if (code >> (3 * component_bits + 2) != 0) return std::nullopt;
    for (unsigned i = 0; i < 3; ++i) { // codes are symmetrical: code 0 has no opposite
        if ((code >> (component_bits * i) & component_mask) == 0) return std::nullopt;
    }
    if (!(smallest_three(code).largest_square >= 0.0)) return std::nullopt;
    return Orientation{code};
}

glm::dquat Orientation::quaternion() const
{
    const SmallestThree three = smallest_three(code_);
    const std::size_t largest = code_ >> (3 * component_bits);
    std::array<double, 4> components{};
    std::size_t next = 0;
    for (std::size_t i = 0; i < 4; ++i)
        components[i] = i == largest ? std::sqrt(three.largest_square) : three.small[next++];
    return {components[0], components[1], components[2], components[3]};
}

BodyStates& BodyStates::operator=(const BodyStates& other)
{
    if (this == &other) return *this;
    count_ = 0;
    for (const BodyState& body : other) std::construct_at(&all_[count_++], body);
    return *this;
}

const BodyState* BodyStates::find(std::uint16_t body) const
{
    const auto* const found =
        std::find_if(begin(), end(), [body](const BodyState& each) { return each.body == body; });
    return found == end() ? nullptr : found;
}

bool operator==(const BodyStates& a, const BodyStates& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

/// Inlines all calls, so that the writer stays in registers even if its bytes may alias it.
template <typename Kind>
[[gnu::flatten]] Datagram Datagram::of(const Kind& message)
{
    Datagram datagram;
    ByteWriter out{datagram.bytes_};
    put(out, message);
    datagram.size_ = out.written().size();
    return datagram;
}

Datagram encode(const Hello& hello) { return Datagram::of(hello); }
Datagram encode(const State& state) { return Datagram::of(state); }
Datagram encode(const Bye& bye) { return Datagram::of(bye); }

Datagram encode(const Message& message)
{
    return std::visit([](const auto& m) { return encode(m); }, message);
}

Result<Message> decode(std::span<const std::byte> datagram)
{
    ByteReader in{datagram};
    if (in.u16() != magic || !in.ok()) return fail("not one of ours");
    if (in.u8() != protocol_version) return fail("another protocol version");
    switch (in.u8()) {
    case type_hello: return taken<Hello>(in);
    case type_state: return taken<State>(in);
    case type_bye: return taken<Bye>(in);
    default: return fail("unknown type");
    }
}

std::optional<std::uint8_t> version_of(std::span<const std::byte> datagram)
{
    ByteReader in{datagram};
    const bool ours = in.u16() == magic;
    const std::uint8_t version = in.u8();
    if (!ours || !in.ok()) return std::nullopt;
    return version;
}

bool is_hello(std::span<const std::byte> datagram)
{
    constexpr std::size_t type_place = 3;
    return datagram.size() > type_place && version_of(datagram) == protocol_version &&
           datagram[type_place] == std::byte{type_hello};
}

} // namespace hapnet::wire
