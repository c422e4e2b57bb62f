// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/omni1394/firewire_omni.hpp"

#include "device/omni1394/registers.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <linux/firewire-cdev.h>
#include <linux/firewire-constants.h>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <stdexcept>
#include <termios.h>
#include <tuple>
#include <unistd.h>
#include <utility>

namespace hapnet::device::omni1394 {

namespace {

std::string testbed_text(const std::string& path, int number)
{
    return fmt::format(
        "P: {0}\nN: fw{1}\nE: DEVNAME=/dev/fw{1}\nE: SUBSYSTEM=firewire\n"
        "A: dev=246:{1}\\n\nA: vendor={2:#08x}\\n\nA: guid={2:#08x}0082b698{1:02x}\\n\n",
        path, number, vendor_id);
}

std::string path_of(int number) { return fmt::format("/devices/pci0000:00/fw{}", number); }

/// A structure of the kernel, of which `size` bytes count, and what follows it.
template <typename T>
std::vector<std::byte> event_of(const T& head, std::size_t size,
                                std::span<const std::byte> rest = {})
{
    std::vector<std::byte> bytes(size);
    std::memcpy(bytes.data(), &head, size);
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
}

std::vector<std::byte> interrupt_of(std::uint32_t cycle, std::span<const std::byte> headers)
{
    fw_cdev_event_iso_interrupt head{};
    head.type = FW_CDEV_EVENT_ISO_INTERRUPT;
    head.cycle = cycle;
    head.header_length = static_cast<std::uint32_t>(headers.size());
    return event_of(head, offsetof(fw_cdev_event_iso_interrupt, header), headers);
}

std::vector<std::byte> reset_event(std::uint32_t generation)
{
    fw_cdev_event_bus_reset head{};
    head.type = FW_CDEV_EVENT_BUS_RESET;
    head.generation = generation;
    return event_of(head, sizeof head);
}

void put_big_endian(std::vector<std::byte>& bytes, std::uint32_t quadlet)
{
    for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes.push_back(std::byte(quadlet >> shift));
}

constexpr std::uint32_t skip_bit = FW_CDEV_ISO_SKIP;
constexpr unsigned cycles_per_second = 8000;

} // namespace

FirewireOmni::FirewireOmni(umockdev::Testbed& testbed, int number, FakeOmni omni)
    : testbed_{testbed}, number_{number}, omni_{std::move(omni)}
{
    testbed_.add(testbed_text(path_of(number_), number_));
    attach();
}

FirewireOmni::~FirewireOmni()
{
    if (slave_ >= 0) close(slave_);
}

std::string FirewireOmni::node() const { return fmt::format("/dev/fw{}", number_); }

void FirewireOmni::attach()
{
    attachment_.emplace(testbed_, node(), static_cast<Handler&>(*this));
    const std::lock_guard lock{mutex_};
    master_ = testbed_.master_of(node());
    slave_ = open(testbed_.real_path(node()).c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (master_ < 0 || slave_ < 0) throw std::runtime_error{node() + " is no terminal"};
}

void FirewireOmni::live(int milliseconds)
{
    const std::lock_guard lock{mutex_};
    for (int i = 0; i < milliseconds; ++i) {
        for (auto& [opener, client] : clients_) transmit(client, 8);
        cycle_ = (cycle_ + 8) % cycles_per_second;
        const Bytes packet = omni_.live(std::chrono::milliseconds{1});
        for (auto& [opener, client] : clients_) receive(client, packet);
    }
}

void FirewireOmni::reset_bus()
{
    const std::lock_guard lock{mutex_};
    ++generation_;
    for (auto& [opener, client] : clients_) {
        if (client.is_in_use) tell(client, reset_event(generation_));
    }
}

void FirewireOmni::unplug()
{
    {
        const std::lock_guard lock{mutex_};
        for (auto& [opener, client] : clients_) {
            client.has_gone = true;
            client.runs = false;
            client.events.clear();
        }
        std::ignore = ::write(master_, "!", 1); // the waiting program then asks for the event
    }
    testbed_.remove("/sys" + path_of(number_));
}

void FirewireOmni::plug_in()
{
    attachment_.reset();
    {
        const std::lock_guard lock{mutex_};
        close(std::exchange(slave_, -1));
        clients_.clear();
        omni_ = FakeOmni{};
        ++number_; // umockdev never reuses a terminal
    }
    testbed_.add(testbed_text(path_of(number_), number_));
    attach();
}

void FirewireOmni::refuse(bool on)
{
    const std::lock_guard lock{mutex_};
    refuses_ = on;
}

void FirewireOmni::on_closed(const void* opener)
{
    const std::lock_guard lock{mutex_};
    clients_.erase(opener);
}

bool FirewireOmni::on_read(const umockdev::Request& request)
{
    const std::lock_guard lock{mutex_};
    Client& client = clients_[request.opener()];
    if (client.events.empty()) {
        if (!client.has_gone) silence();
        request.fail(client.has_gone ? ENODEV : EAGAIN);
        return true;
    }
    const Bytes event = std::exchange(client.events.front(), {});
    client.events.pop_front();
    silence();
    umockdev::Memory buffer = request.buffer();
    const std::size_t size = std::min(event.size(), buffer.bytes().size());
    buffer.write(0, std::span{event}.first(size));
    request.succeed(static_cast<long>(size));
    return true;
}

void FirewireOmni::tell(Client& client, Bytes event)
{
    client.events.push_back(std::move(event));
    std::ignore = ::write(slave_ < 0 ? -1 : master_, "!", 1);
}

/// The bell is for all clients. It stops once none of them has an event to read.
void FirewireOmni::silence()
{
    const bool is_quiet = std::all_of(clients_.begin(), clients_.end(), [](const auto& entry) {
        return entry.second.events.empty() && !(entry.second.has_gone && entry.second.is_in_use);
    });
    if (is_quiet) tcflush(slave_, TCIFLUSH);
}

bool FirewireOmni::on_ioctl(const umockdev::Request& request)
{
    const std::lock_guard lock{mutex_};
    Client& client = clients_[request.opener()];
    const int error = client.has_gone ? ENODEV : answer(request, client);
    if (error == 0) {
        request.succeed();
    } else {
        request.fail(error);
    }
    return true;
}

int FirewireOmni::answer(const umockdev::Request& request, Client& client)
{
    switch (request.code()) {
    case FW_CDEV_IOC_GET_INFO: // the first request of every program
        client = Client{};
        get_info(request);
        return 0;
    case FW_CDEV_IOC_SEND_REQUEST: send_request(request, client); return 0;
    case FW_CDEV_IOC_ALLOCATE_ISO_RESOURCE: allocate(request, client); return 0;
    case FW_CDEV_IOC_CREATE_ISO_CONTEXT: return create_context(request, client);
    case FW_CDEV_IOC_QUEUE_ISO: return queue(request, client);
    case FW_CDEV_IOC_START_ISO:
        if (!client.context) return EINVAL;
        client.runs = true;
        return 0;
    case FW_CDEV_IOC_STOP_ISO:
        if (!client.context) return EINVAL;
        client.runs = false;
        client.is_in_use = false;
        return 0;
    case FW_CDEV_IOC_FLUSH_ISO:
        if (!client.context) return EINVAL;
        transmit(client, 8); // while a program asks, time passes on the bus
        return 0;
    default: return ENOTTY;
    }
}

void FirewireOmni::get_info(const umockdev::Request& request) const
{
    umockdev::Memory argument = request.argument(sizeof(fw_cdev_get_info));
    auto info = argument.as<fw_cdev_get_info>();
    if (info.bus_reset != 0) {
        const Bytes reset = reset_event(generation_);
        argument.pointed_to(offsetof(fw_cdev_get_info, bus_reset), 36)
            .write(0, std::span{reset}.first(36)); // as many bytes as the kernel writes
    }
    argument.write_as(std::uint32_t{5}, offsetof(fw_cdev_get_info, version));
}

void FirewireOmni::send_request(const umockdev::Request& request, Client& client)
{
    const umockdev::Memory argument = request.argument(sizeof(fw_cdev_send_request));
    const auto sent = argument.as<fw_cdev_send_request>();
    fw_cdev_event_response head{};
    head.closure = sent.closure;
    head.type = FW_CDEV_EVENT_RESPONSE;
    head.rcode = RCODE_COMPLETE;
    Bytes data;
    if (refuses_ || sent.generation != generation_) {
        head.rcode = refuses_ ? RCODE_ADDRESS_ERROR : RCODE_GENERATION;
    } else if (sent.tcode == TCODE_READ_QUADLET_REQUEST || sent.tcode == TCODE_READ_BLOCK_REQUEST) {
        const auto value = omni_.read_register(sent.offset, sent.length);
        if (!value) head.rcode = RCODE_ADDRESS_ERROR;
        data = value.value_or(Bytes{});
    } else {
        const umockdev::Memory value =
            argument.pointed_to(offsetof(fw_cdev_send_request, data), sent.length);
        if (!omni_.write_register(sent.offset, value.bytes())) head.rcode = RCODE_ADDRESS_ERROR;
    }
    head.length = static_cast<std::uint32_t>(data.size());
    tell(client, event_of(head, offsetof(fw_cdev_event_response, data), data));
}

void FirewireOmni::allocate(const umockdev::Request& request, Client& client)
{
    umockdev::Memory argument = request.argument(sizeof(fw_cdev_allocate_iso_resource));
    const auto wanted = argument.as<fw_cdev_allocate_iso_resource>();
    fw_cdev_event_iso_resource head{};
    head.type = FW_CDEV_EVENT_ISO_RESOURCE_ALLOCATED;
    head.handle = static_cast<std::uint32_t>(channels_given_ + 1);
    head.channel = channels_given_++ % 31;
    head.bandwidth = static_cast<std::int32_t>(wanted.bandwidth);
    argument.write_as(head.handle, offsetof(fw_cdev_allocate_iso_resource, handle));
    for (auto& [opener, other] : clients_) other.is_in_use = false;
    client.is_in_use = true;
    tell(client, event_of(head, sizeof head));
}

int FirewireOmni::create_context(const umockdev::Request& request, Client& client)
{
    if (client.context) return EBUSY; // one context for each descriptor
    const auto wanted =
        request.argument(sizeof(fw_cdev_create_iso_context)).as<fw_cdev_create_iso_context>();
    if (wanted.header_size % 4 != 0 || wanted.header_size < 4) return EINVAL;
    client.context = wanted.type;
    client.is_in_use = true;
    client.channel = wanted.channel;
    client.header_size = wanted.header_size;
    return 0;
}

int FirewireOmni::queue(const umockdev::Request& request, Client& client)
{
    const umockdev::Memory argument = request.argument(sizeof(fw_cdev_queue_iso));
    const auto wanted = argument.as<fw_cdev_queue_iso>();
    if (!client.context) return EINVAL;
    const umockdev::Memory packets =
        argument.pointed_to(offsetof(fw_cdev_queue_iso, packets), wanted.size);
    auto left = packets.bytes();
    const bool sends = *client.context == FW_CDEV_ISO_CONTEXT_TRANSMIT;
    while (left.size() >= sizeof(std::uint32_t)) {
        std::uint32_t control = 0;
        std::memcpy(&control, left.data(), sizeof control);
        left = left.subspan(sizeof control);
        const std::size_t header = control >> 24U;
        if ((control & 0xffffU) != 0) return EINVAL; // there is no memory mapped for it
        if (!sends) {
            if (header == 0 || header % client.header_size != 0) return EINVAL;
            client.room += header / client.header_size;
            continue;
        }
        if (header % 4 != 0 || left.size() < header) return EINVAL;
        if ((control & skip_bit) != 0 && header != 0) return EINVAL;
        client.to_send.push_back({Bytes(left.begin(), left.begin() + std::ptrdiff_t(header)),
                                  (control & FW_CDEV_ISO_INTERRUPT) != 0});
        left = left.subspan(header);
    }
    return 0;
}

void FirewireOmni::transmit(Client& client, int cycles)
{
    if (!client.runs || client.context != std::uint32_t{FW_CDEV_ISO_CONTEXT_TRANSMIT}) return;
    for (int i = 0; i < cycles && !client.to_send.empty(); ++i) {
        const Packet packet = std::exchange(client.to_send.front(), {});
        client.to_send.pop_front();
        const auto channel = omni_.read_register(to_device_channel_register, 1);
        const bool is_for_it = std::to_integer<std::uint32_t>(channel->front()) == client.channel;
        if (is_for_it && !packet.bytes.empty()) omni_.hear(packet.bytes);
        ++client.sent;
        if (!packet.interrupts) continue;
        const Bytes stamps(std::exchange(client.sent, 0) * sizeof(std::uint32_t));
        tell(client, interrupt_of(cycle_, stamps));
    }
}

void FirewireOmni::receive(Client& client, const Bytes& packet)
{
    if (!client.runs || client.context != std::uint32_t{FW_CDEV_ISO_CONTEXT_RECEIVE}) return;
    const auto channel = omni_.read_register(to_host_channel_register, 1);
    const bool is_for_it = std::to_integer<std::uint32_t>(channel->front()) == client.channel;
    if (packet.empty() || !is_for_it || client.room == 0) return;
    --client.room;
    Bytes header;
    put_big_endian(header, static_cast<std::uint32_t>(packet.size() << 16U | client.channel << 8U |
                                                      TCODE_STREAM_DATA << 4U));
    put_big_endian(header, cycle_);
    header.insert(header.end(), packet.begin(), packet.end());
    header.resize(client.header_size);
    tell(client, interrupt_of(cycle_, header));
}

} // namespace hapnet::device::omni1394
