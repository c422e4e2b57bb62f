// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/ros_messages.hpp"

#include "lab/records/mcap.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::lab::records {

namespace {

// The messages' definitions, from ROS 2's common_interfaces (Apache 2.0), without comments.
constexpr std::string_view header_and_time = R"(
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
)";
constexpr std::string_view pose = R"(std_msgs/Header header
geometry_msgs/Pose pose
================================================================================
MSG: geometry_msgs/Pose
geometry_msgs/Point position
geometry_msgs/Quaternion orientation
================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w)";
constexpr std::string_view wrench = R"(std_msgs/Header header
geometry_msgs/Wrench wrench
================================================================================
MSG: geometry_msgs/Wrench
geometry_msgs/Vector3 force
geometry_msgs/Vector3 torque
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z)";

/// A CDR message (DDS-RTPS 2.2, section 10), little-endian. Each number is aligned to a multiple of
/// its size, counted from the end of the four bytes of the header.
class CdrMessage {
public:
    explicit CdrMessage(std::uint64_t time_ns)
    {
        constexpr std::uint64_t second = 1'000'000'000;
        constexpr std::string_view frame = "hapnet";
        put(static_cast<std::uint32_t>(time_ns / second));
        put(static_cast<std::uint32_t>(time_ns % second));
        put(static_cast<std::uint32_t>(frame.size() + 1)); // including the final zero byte
        bytes_ += frame;
        bytes_ += '\0';
    }

    CdrMessage& add(double value)
    {
        put(std::bit_cast<std::uint64_t>(value));
        return *this;
    }

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    static constexpr std::size_t head = 4;

    void put(std::unsigned_integral auto value)
    {
        while ((bytes_.size() - head) % sizeof value != 0) bytes_ += '\0';
        for (std::size_t i = 0; i < sizeof value; ++i)
            bytes_ += static_cast<char>(value >> (8 * i) & 0xff);
    }

    std::string bytes_ = std::string{"\0\1\0\0", head};
};

/// The data of one side for the file. `time` converts its clock.
struct Source {
    std::int64_t peer = 0;
    std::span<const record::TickRow> ticks{};
    std::span<const record::BodyRow> bodies{};
    std::function<base::TimePoint(base::TimePoint)> time{};
};

std::uint64_t nanoseconds(base::TimePoint time)
{
    return static_cast<std::uint64_t>(std::max<std::int64_t>(time.time_since_epoch().count(), 0));
}

/// The channels of a peer, and its messages into them.
class PeerTopics {
public:
    PeerTopics(McapWriter& writer, const Source& source, std::uint16_t pose_schema,
               std::uint16_t wrench_schema)
        : writer_{writer}, source_{source}
    {
        const auto topic = [&](std::uint16_t schema, std::string_view name) {
            return writer.add_channel(schema, fmt::format("/peer_{}/{}", source.peer, name));
        };
        hip_ = topic(pose_schema, "hip");
        contact_ = topic(wrench_schema, "contact_force");
        device_ = topic(wrench_schema, "device_force");
        for (const record::BodyRow& row : source.bodies) {
            if (bodies_.contains(row.body)) continue;
            bodies_[row.body] = topic(pose_schema, fmt::format("body_{}", row.body));
        }
        if (source.bodies.empty()) body_ = topic(pose_schema, "body");
    }

    void write() const
    {
        auto body = source_.bodies.begin();
        for (const record::TickRow& tick : source_.ticks) {
            const auto time_ns = nanoseconds(source_.time(tick.at()));
            write_pose(hip_, time_ns, tick.hip, {1.0, 0.0, 0.0, 0.0});
            write_force(contact_, time_ns, tick.contact);
            write_force(device_, time_ns, tick.device);
            if (source_.bodies.empty()) write_pose(body_, time_ns, tick.cube, {1.0, 0.0, 0.0, 0.0});
            while (body != source_.bodies.end() && body->tick < tick.tick) ++body;
            for (; body != source_.bodies.end() && body->tick == tick.tick; ++body)
                write_pose(bodies_.at(body->body), time_ns, body->position, body->orientation);
        }
    }

private:
    void write_pose(std::uint16_t channel, std::uint64_t time_ns, const base::Position& at,
                    const glm::dquat& turned) const
    {
        CdrMessage message{time_ns};
        message.add(at.x()).add(at.y()).add(at.z());
        message.add(turned.x).add(turned.y).add(turned.z).add(turned.w);
        writer_.write(channel, time_ns, message.bytes());
    }
    void write_force(std::uint16_t channel, std::uint64_t time_ns, const base::Force& force) const
    {
        CdrMessage message{time_ns};
        message.add(force.x()).add(force.y()).add(force.z());
        message.add(0.0).add(0.0).add(0.0); // no torque
        writer_.write(channel, time_ns, message.bytes());
    }

    McapWriter& writer_;
    const Source& source_;
    std::uint16_t hip_ = 0;
    std::uint16_t contact_ = 0;
    std::uint16_t device_ = 0;
    std::uint16_t body_ = 0; // channel of the body in a record without rows of bodies
    std::map<std::uint16_t, std::uint16_t> bodies_;
};

void write_sources(const std::vector<Source>& sources,
                   const std::function<void(std::string_view)>& take)
{
    McapWriter writer{take};
    const auto pose_schema = writer.add_schema("geometry_msgs/msg/PoseStamped",
                                               fmt::format("{}{}", pose, header_and_time));
    const auto wrench_schema = writer.add_schema("geometry_msgs/msg/WrenchStamped",
                                                 fmt::format("{}{}", wrench, header_and_time));
    std::vector<PeerTopics> topics;
    topics.reserve(sources.size());
    for (const Source& source : sources)
        topics.emplace_back(writer, source, pose_schema, wrench_schema);
    for (const PeerTopics& one : topics) one.write();
    writer.finish();
}

} // namespace

void write_mcap(const record::Record& record, const std::function<void(std::string_view)>& take)
{
    const auto id = record.config.find("peer_id");
    const bool has_id = id != record.config.end() && id->is_number_integer();
    write_sources({{has_id ? id->get<std::int64_t>() : 0, record.ticks, record.bodies,
                    [](base::TimePoint time) { return time; }}},
                  take);
}

void write_mcap(const Session& session, const std::function<void(std::string_view)>& take)
{
    const auto bodies_of = [](const Side& side) -> std::span<const record::BodyRow> {
        const auto ticks = side.ticks;
        if (ticks.empty()) return {};
        const auto first =
            std::ranges::lower_bound(side.bodies, ticks.front().tick, {}, &record::BodyRow::tick);
        const auto last =
            std::ranges::upper_bound(side.bodies, ticks.back().tick, {}, &record::BodyRow::tick);
        return {first, last};
    };
    const Clock& clock = session.clock;
    write_sources({{session.a.peer_id, session.a.ticks, bodies_of(session.a),
                    [](base::TimePoint time) { return time; }},
                   {session.b.peer_id, session.b.ticks, bodies_of(session.b),
                    [&](base::TimePoint time) { return clock.to_a(time); }}},
                  take);
}

} // namespace hapnet::lab::records
