// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/telemetry/frame.hpp"

#include <array>
#include <cmath>
#include <iterator>
#include <spdlog/fmt/fmt.h>

namespace hapnet::telemetry {

namespace {

/// Writes the members of one object.
class Writer {
public:
    explicit Writer(std::string& text) : text_{text} {}

    template <typename... Values>
    void put(fmt::format_string<Values...> form, Values&&... values)
    {
        fmt::format_to(std::back_inserter(text_), form, std::forward<Values>(values)...);
    }

    /// JSON has no number for what is not finite.
    void number(double value)
    {
        if (std::isfinite(value)) {
            put("{:.7g}", value);
        } else {
            text_ += "null";
        }
    }

    void vector(std::string_view key, const glm::dvec3& v)
    {
        put(",\"{}\":[", key);
        numbers(std::array{v.x, v.y, v.z});
    }

    void numbers(const auto& values)
    {
        bool is_first = true;
        for (const double value : values) {
            if (!is_first) text_ += ',';
            is_first = false;
            number(value);
        }
        text_ += ']';
    }

    void milliseconds(std::string_view key, const std::optional<base::Duration>& time)
    {
        put(",\"{}\":", key);
        if (time) {
            put("{:.4f}", base::to_seconds(*time) * 1e3);
        } else {
            text_ += "null";
        }
    }

    void truth(std::string_view key, bool is_true) { put(",\"{}\":{}", key, is_true); }

    /// {"min":..,"mean":..,"max":..}, or null.
    void spread(const Spread& spread)
    {
        if (spread.empty()) {
            text_ += "null";
            return;
        }
        text_ += "{\"min\":";
        number(spread.min());
        text_ += ",\"mean\":";
        number(spread.mean());
        text_ += ",\"max\":";
        number(spread.max());
        text_ += '}';
    }

    void maximum(std::string_view key, const Spread& spread)
    {
        put(",\"{}\":{{\"max\":", key);
        number(spread.max());
        text_ += '}';
    }

private:
    std::string& text_;
};

void write_session(Writer& out, const Frame& frame)
{
    const std::string_view phase = record::name_of(frame.tick.phase);
    if (frame.session) {
        out.put(",\"session\":{{\"number\":{},\"at_s\":{:.4f},\"phase\":\"{}\"}}",
                frame.session->session, base::to_seconds(frame.tick.at() - frame.session->start),
                phase);
    } else {
        out.put(",\"session\":null");
    }
    out.put(",\"phase\":\"{}\"", phase);
}

void write_bodies(Writer& out, const Frame& frame)
{
    if (frame.bodies.empty()) return;
    out.put(",\"bodies\":[");
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
        const BodyFrame& body = frame.bodies[i];
        const glm::dquat& q = body.orientation;
        out.put("{}{{\"body\":{}", i == 0 ? "" : ",", body.body);
        out.vector("position", body.position.value);
        out.vector("velocity", body.velocity.value);
        out.put(",\"orientation\":[");
        out.numbers(std::array{q.w, q.x, q.y, q.z});
        out.put("}}");
    }
    out.put("]");
}

void write_heard(Writer& out, const Frame& frame)
{
    out.put(",\"heard\":[");
    for (std::size_t i = 0; i < frame.heard.size(); ++i) {
        const HeardFrame& heard = frame.heard[i];
        out.put("{}{{\"from\":{},\"n\":{},\"lost\":{},\"late\":{},\"delay_ms\":", i == 0 ? "" : ",",
                heard.from, heard.messages, heard.lost, heard.late);
        out.spread(heard.delay_ms);
        out.milliseconds("age_ms", heard.age);
        out.milliseconds("offset_ms", heard.offset);
        out.milliseconds("uncertainty_ms", heard.offset_uncertainty);
        out.put("}}");
    }
    out.put("]");
}

} // namespace

void append_json(std::string& text, const Frame& frame)
{
    Writer out{text};
    const record::TickRow& tick = frame.tick;
    out.put("{{\"ok\":true,\"frame\":{},\"at_ns\":{},\"peer\":{},\"tick\":{}", frame.number,
            tick.at().time_since_epoch().count(), frame.peer, tick.tick);
    write_session(out, frame);
    out.vector("hip", tick.hip.value);
    out.vector("hip_v", tick.hip_velocity.value);
    out.vector("cube", tick.cube.value);
    out.vector("cube_v", tick.cube_velocity.value);
    out.vector("hand_force", tick.device.value);
    out.vector("body_force", tick.contact.value);
    out.vector("remote_force", tick.remote.value);
    out.truth("touching", tick.touching);
    out.truth("remote_touching", tick.remote_touching);
    out.truth("remote_fresh", tick.remote_fresh);
    out.put(",\"cube_x\":{{\"min\":");
    out.number(frame.cube_x_m.min());
    out.put(",\"max\":");
    out.number(frame.cube_x_m.max());
    out.put("}}");
    out.maximum("force_n", frame.force_n);
    out.maximum("late_us", frame.late_us);
    out.put(",\"ticks\":{},\"missed\":{}", frame.late_us.count(), frame.missed);
    write_bodies(out, frame);
    write_heard(out, frame);
    out.put(",\"governor\":\"{}\",\"fault\":", frame.governor);
    if (frame.fault) {
        out.put("\"{}\"", *frame.fault);
    } else {
        out.put("null");
    }
    if (frame.left_out > 0) out.put(",\"left_out\":{}", frame.left_out);
    out.put("}}");
}

} // namespace hapnet::telemetry
