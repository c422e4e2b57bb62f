// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/transport/node.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <linux/firewire-cdev.h>
#include <poll.h>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::device::omni1394 {

namespace {

// The first version with events that do not lose headers, and the last one without time stamps.
constexpr std::uint32_t interface_version = 5;

Fault fault_of(int error)
{
    switch (error) {
    case ENOENT:
    case ENXIO: return Fault::not_found;
    case ENODEV: return Fault::disconnected;
    case EACCES:
    case EPERM: return Fault::permission;
    case EBUSY: return Fault::in_use;
    default: return Fault::communication;
    }
}

std::uint64_t address_of(void* pointer)
{
    // The kernel's interface has pointers as numbers.
    return reinterpret_cast<std::uintptr_t>(pointer); // NOLINT(*-reinterpret-cast)
}

} // namespace

DeviceError error_of(int error, const std::string& what)
{
    const Fault fault = fault_of(error);
    return {
        fault,
        fmt::format("{}: {}: {}", what, std::generic_category().message(error), describe(fault)),
        error};
}

std::uint32_t Event::type() const
{
    fw_cdev_event_common common{};
    if (size < sizeof common) return std::numeric_limits<std::uint32_t>::max();
    std::memcpy(&common, bytes.data(), sizeof common);
    return common.type;
}

Opened<Node> Node::open(const std::string& path)
{
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0) return tl::unexpected{error_of(errno, path)};
    Node node{descriptor, 0};
    fw_cdev_event_bus_reset reset{};
    fw_cdev_get_info info{};
    info.version = interface_version;
    info.bus_reset = address_of(&reset);
    if (const int error = node.control(FW_CDEV_IOC_GET_INFO, &info); error != 0) {
        return tl::unexpected{error_of(error, path)};
    }
    node.generation_ = reset.generation;
    return node;
}

Node::~Node()
{
    if (descriptor_ >= 0) ::close(descriptor_);
}

Node::Node(Node&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)}, generation_{other.generation_}
{}

Node& Node::operator=(Node&& other) noexcept
{
    std::swap(descriptor_, other.descriptor_);
    std::swap(generation_, other.generation_);
    return *this;
}

bool Node::lock() { return ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0; }

int Node::control(unsigned long request, void* argument) const noexcept
{
    int result = 0;
    do {
        result = ::ioctl(descriptor_, request, argument);
    } while (result < 0 && errno == EINTR);
    return result < 0 ? errno : 0;
}

ReadOutcome Node::read(Event& event, base::Duration within) const noexcept
{
    // read() of such a node blocks in any mode, so the node is polled first.
    pollfd ready{descriptor_, POLLIN, 0};
    const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(within).count();
    if (::poll(&ready, 1, static_cast<int>(milliseconds)) <= 0) return ReadOutcome::nothing;
    const ssize_t size = ::read(descriptor_, event.bytes.data(), event.bytes.size());
    if (size > 0) {
        event.size = static_cast<std::size_t>(size);
        return ReadOutcome::event;
    }
    const bool is_over = size == 0 || (errno != EAGAIN && errno != EINTR);
    return is_over ? ReadOutcome::gone : ReadOutcome::nothing;
}

} // namespace hapnet::device::omni1394
