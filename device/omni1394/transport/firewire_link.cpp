// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/transport/firewire_link.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <linux/firewire-cdev.h>
#include <linux/firewire-constants.h>
#include <poll.h>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::device::omni1394 {

namespace {

using namespace std::chrono_literals;

constexpr base::Duration answer_within = 500ms;
// After a bus reset the kernel waits for a second before it allocates channels.
constexpr base::Duration channel_within = 2s;
// Channels 0 to 30: the next one is the broadcast channel.
constexpr std::uint64_t channels_to_choose_from = 0x7fffffff;
// The bytes of a packet in addition to its data, which are a header and two checksums, and the
// bandwidth that each packet needs on the bus in addition to its bytes (as the kernel's own sound
// drivers compute it).
constexpr std::uint32_t packet_overhead_bytes = 12;
constexpr std::uint32_t bandwidth_overhead = 512;

// A command is for a millisecond: one packet in each of the bus's cycles, as in the programs that
// ran with the device.
constexpr int packets_per_command = 8;
constexpr int pushing_packets_max = 2 * packets_per_command;
constexpr int sending_packets_max = 16 * packets_per_command;
// Header, time stamp, and the greatest contents of a packet.
constexpr std::uint32_t received_bytes = 8 + device_packet_bytes_max;
constexpr std::size_t receive_room = 64; // packets

/// One packet in the array of <linux/firewire-cdev.h>, with its header.
struct PacketToSend {
    std::uint32_t control = FW_CDEV_ISO_HEADER_LENGTH(std::uint32_t{host_packet_bytes});
    HostBytes bytes{};
};
static_assert(sizeof(PacketToSend) == sizeof(std::uint32_t) + host_packet_bytes);

std::uint64_t address_of(const void* pointer)
{
    // The kernel's interface has pointers as numbers.
    return reinterpret_cast<std::uintptr_t>(pointer); // NOLINT(*-reinterpret-cast)
}

/// Reads a structure of the kernel at the beginning of an event.
template <typename T>
bool read_as(T& target, const Event& event, std::size_t least)
{
    if (event.size < least) return false;
    std::memcpy(&target, event.bytes.data(), std::min(event.size, sizeof target));
    return true;
}

std::uint32_t big_endian_at(std::span<const std::byte> bytes)
{
    std::uint32_t value = 0;
    for (const std::byte byte : bytes.first(4)) value = value << 8U | std::uint32_t(byte);
    return value;
}

constexpr std::size_t headers_at = offsetof(fw_cdev_event_iso_interrupt, header);

/// Returns the headers of an event with isochronous packets.
std::span<const std::byte> headers_of(const Event& event)
{
    fw_cdev_event_iso_interrupt interrupt{};
    if (event.type() != FW_CDEV_EVENT_ISO_INTERRUPT || !read_as(interrupt, event, headers_at)) {
        return {};
    }
    const auto left = event.content().subspan(headers_at);
    return left.first(std::min<std::size_t>(left.size(), interrupt.header_length));
}

} // namespace

FirewireLink::FirewireLink(Node node, Node sender, Node receiver)
    : node_{std::move(node)}, sender_{std::move(sender)}, receiver_{std::move(receiver)}
{}

FirewireLink::~FirewireLink()
{
    fw_cdev_stop_iso stop{};
    std::ignore = sender_.control(FW_CDEV_IOC_STOP_ISO, &stop);
    std::ignore = receiver_.control(FW_CDEV_IOC_STOP_ISO, &stop);
    // Closing releases the channels.
}

Opened<std::unique_ptr<Link>> FirewireLink::open(const std::string& path)
{
    auto node = Node::open(path);
    if (!node) return tl::unexpected{node.error()};
    if (!node->lock()) {
        return device_error(Fault::in_use, fmt::format("{}: {}", path, describe(Fault::in_use)));
    }
    auto sender = Node::open(path);
    if (!sender) return tl::unexpected{sender.error()};
    auto receiver = Node::open(path);
    if (!receiver) return tl::unexpected{receiver.error()};
    return std::unique_ptr<Link>{
        new FirewireLink{*std::move(node), *std::move(sender), *std::move(receiver)}};
}

Opened<Channels> FirewireLink::allocate()
{
    const auto to_device = allocate_channel(host_packet_bytes);
    if (!to_device) return tl::unexpected{to_device.error()};
    const auto to_host = allocate_channel(device_packet_bytes_max);
    if (!to_host) return tl::unexpected{to_host.error()};
    return Channels{*to_device, *to_host};
}

Opened<std::uint8_t> FirewireLink::allocate_channel(std::uint32_t bytes)
{
    fw_cdev_allocate_iso_resource wanted{};
    wanted.channels = channels_to_choose_from;
    // The unit is quadlets at 1600 Mbit/s: at 100 Mbit/s four for each byte.
    wanted.bandwidth = 4 * (packet_overhead_bytes + bytes) + bandwidth_overhead;
    const std::string what = "a channel of the FireWire bus";
    if (const int error = node_.control(FW_CDEV_IOC_ALLOCATE_ISO_RESOURCE, &wanted); error != 0) {
        return tl::unexpected{error_of(error, what)};
    }
    while (node_.read(event_, channel_within) == ReadOutcome::event) {
        fw_cdev_event_iso_resource given{};
        if (event_.type() != FW_CDEV_EVENT_ISO_RESOURCE_ALLOCATED ||
            !read_as(given, event_, sizeof given) || given.handle != wanted.handle) {
            continue;
        }
        if (given.channel >= 0 && given.bandwidth > 0) {
            return static_cast<std::uint8_t>(given.channel);
        }
        return device_error(Fault::in_use, what + ": none is free; unplug other FireWire devices");
    }
    return device_error(Fault::timeout, what +
                                            ": the bus does not answer; unplug the device and plug "
                                            "it in again");
}

Opened<std::size_t> FirewireLink::read_register(std::uint64_t address, std::span<std::byte> bytes)
{
    const bool is_quadlet = bytes.size() == 4;
    return transact(is_quadlet ? TCODE_READ_QUADLET_REQUEST : TCODE_READ_BLOCK_REQUEST, address, {},
                    bytes);
}

Opened<std::size_t> FirewireLink::write_register(std::uint64_t address,
                                                 std::span<const std::byte> bytes)
{
    const bool is_quadlet = bytes.size() == 4;
    return transact(is_quadlet ? TCODE_WRITE_QUADLET_REQUEST : TCODE_WRITE_BLOCK_REQUEST, address,
                    bytes, {});
}

Opened<std::size_t> FirewireLink::transact(std::uint32_t code, std::uint64_t address,
                                           std::span<const std::byte> request,
                                           std::span<std::byte> response)
{
    fw_cdev_send_request sent{};
    sent.tcode = code;
    sent.length = static_cast<std::uint32_t>(request.empty() ? response.size() : request.size());
    sent.offset = address;
    sent.closure = ++requests_;
    sent.data = request.empty() ? 0 : address_of(request.data());
    sent.generation = node_.generation();
    const std::string what = fmt::format("register {:#x}", address);
    if (const int error = node_.control(FW_CDEV_IOC_SEND_REQUEST, &sent); error != 0) {
        return tl::unexpected{error_of(error, what)};
    }
    while (node_.read(event_, answer_within) == ReadOutcome::event) {
        fw_cdev_event_response answer{};
        constexpr std::size_t data_at = offsetof(fw_cdev_event_response, data);
        if (event_.type() != FW_CDEV_EVENT_RESPONSE || !read_as(answer, event_, data_at) ||
            answer.closure != requests_) {
            continue;
        }
        if (answer.rcode != RCODE_COMPLETE) {
            return device_error(
                Fault::communication,
                fmt::format("{}: the device refuses ({:#x}); unplug it and plug it in "
                            "again",
                            what, answer.rcode),
                answer.rcode);
        }
        const auto data = event_.content().subspan(data_at);
        const std::size_t size =
            std::min({data.size(), std::size_t{answer.length}, response.size()});
        std::copy_n(data.begin(), size, response.begin());
        return size;
    }
    return device_error(Fault::timeout, what + ": no answer; check the device's cable and power");
}

Opened<Channels> FirewireLink::start(const Channels& channels)
{
    const auto check = [](int error, const char* what) -> Opened<int> {
        if (error == 0) return 0;
        return tl::unexpected{error_of(error, what)};
    };
    fw_cdev_start_iso begin{};
    begin.cycle = -1;
    begin.tags = FW_CDEV_ISO_CONTEXT_MATCH_ALL_TAGS;
    auto done =
        check(make_context(receiver_, FW_CDEV_ISO_CONTEXT_RECEIVE, channels.to_host), "receiving");
    if (done) done = check(queue_room(receive_room), "receiving");
    if (done) done = check(receiver_.control(FW_CDEV_IOC_START_ISO, &begin), "receiving");
    if (done) {
        done = check(make_context(sender_, FW_CDEV_ISO_CONTEXT_TRANSMIT, channels.to_device),
                     "sending");
    }
    // A packet must be queued before the start.
    if (done && !send(HostPacket{})) done = check(EIO, "sending");
    if (done) done = check(sender_.control(FW_CDEV_IOC_START_ISO, &begin), "sending");
    if (!done) return tl::unexpected{done.error()};
    return channels;
}

int FirewireLink::make_context(Node& node, std::uint32_t type, std::uint8_t channel)
{
    fw_cdev_create_iso_context context{};
    context.type = type;
    context.header_size = received_bytes; // without meaning for sending
    context.channel = channel;
    context.speed = SCODE_100;
    return node.control(FW_CDEV_IOC_CREATE_ISO_CONTEXT, &context);
}

int FirewireLink::queue_room(std::size_t packets) noexcept
{
    std::array<std::uint32_t, receive_room> controls{};
    const std::size_t count = std::min(packets, controls.size());
    controls.fill(FW_CDEV_ISO_HEADER_LENGTH(received_bytes) | FW_CDEV_ISO_INTERRUPT);
    fw_cdev_queue_iso queue{};
    queue.packets = address_of(controls.data());
    queue.size = static_cast<std::uint32_t>(count * sizeof controls.front());
    return receiver_.control(FW_CDEV_IOC_QUEUE_ISO, &queue);
}

bool FirewireLink::send(const HostPacket& packet) noexcept
{
    const bool pushes = packet.motors_on || packet.motors != glm::ivec3{0};
    const int most = pushes ? pushing_packets_max : sending_packets_max;
    if (sending_.load(std::memory_order_relaxed) >= most) return false;
    std::array<PacketToSend, packets_per_command> packets{};
    const HostBytes bytes = encode(packet);
    for (PacketToSend& one : packets) one.bytes = bytes;
    packets.back().control |= FW_CDEV_ISO_INTERRUPT;
    fw_cdev_queue_iso queue{};
    queue.packets = address_of(packets.data());
    queue.size = sizeof packets;
    sending_.fetch_add(packets_per_command, std::memory_order_relaxed);
    if (sender_.control(FW_CDEV_IOC_QUEUE_ISO, &queue) == 0) return true;
    sending_.fetch_sub(packets_per_command, std::memory_order_relaxed);
    return false;
}

void FirewireLink::count_what_was_sent(base::Duration within) noexcept
{
    while (sender_.read(event_, within) == ReadOutcome::event) {
        within = base::Duration{0};
        const auto sent = headers_of(event_).size() / sizeof(std::uint32_t);
        sending_.fetch_sub(static_cast<int>(sent), std::memory_order_relaxed);
    }
}

void FirewireLink::drain() noexcept
{
    constexpr int milliseconds_max = 40;
    for (int i = 0; i < milliseconds_max && sending_.load(std::memory_order_relaxed) > 0; ++i) {
        count_what_was_sent(1ms);
        fw_cdev_flush_iso flush{};
        if (sender_.control(FW_CDEV_IOC_FLUSH_ISO, &flush) != 0) return;
    }
}

Arrival FirewireLink::receive(ReceivedPacket& packet) noexcept
{
    if (at_ < packets_.size) return next_of_event(packet);
    count_what_was_sent(base::Duration{0});
    if (const Arrival arrival = hear_of(node_); arrival != Arrival::nothing) return arrival;
    switch (receiver_.read(packets_, base::Duration{0})) {
    case ReadOutcome::gone: packets_.size = 0; return Arrival::gone;
    case ReadOutcome::nothing: packets_.size = 0; return Arrival::nothing;
    case ReadOutcome::event: break;
    }
    const auto headers = headers_of(packets_);
    if (headers.size() < received_bytes) {
        packets_.size = 0; // a bus reset, which node_ reports, too
        return Arrival::nothing;
    }
    at_ = headers_at;
    packets_.size = headers_at + headers.size() / received_bytes * received_bytes;
    if (queue_room(headers.size() / received_bytes) != 0) return Arrival::gone;
    return next_of_event(packet);
}

Arrival FirewireLink::next_of_event(ReceivedPacket& packet) noexcept
{
    const auto header = packets_.content().subspan(at_, received_bytes);
    at_ += received_bytes;
    if (at_ >= packets_.size) packets_.size = 0;
    const std::size_t data_length = big_endian_at(header) >> 16U;
    packet.size = std::min(data_length, packet.bytes.size());
    packet.cycle = big_endian_at(header.subspan(4)) & 0x1fffU;
    std::copy_n(header.begin() + 8, packet.size, packet.bytes.begin());
    return Arrival::packet;
}

Arrival FirewireLink::hear_of(const Node& node) noexcept
{
    switch (node.read(event_, base::Duration{0})) {
    case ReadOutcome::gone: return Arrival::gone;
    case ReadOutcome::nothing: return Arrival::nothing;
    case ReadOutcome::event: break;
    }
    fw_cdev_event_bus_reset reset{};
    constexpr std::size_t least = offsetof(fw_cdev_event_bus_reset, generation) + 4;
    if (event_.type() == FW_CDEV_EVENT_ISO_RESOURCE_DEALLOCATED) return Arrival::bus_reset;
    if (event_.type() != FW_CDEV_EVENT_BUS_RESET || !read_as(reset, event_, least)) {
        return Arrival::nothing;
    }
    node_.set_generation(reset.generation);
    return Arrival::bus_reset;
}

bool FirewireLink::wait(base::Duration most) noexcept
{
    if (at_ < packets_.size) return true;
    std::array<pollfd, 2> ready{pollfd{node_.descriptor(), POLLIN, 0},
                                pollfd{receiver_.descriptor(), POLLIN, 0}};
    const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(most).count();
    return ::poll(ready.data(), ready.size(), static_cast<int>(milliseconds)) > 0;
}

} // namespace hapnet::device::omni1394
