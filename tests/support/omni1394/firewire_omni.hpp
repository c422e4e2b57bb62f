// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/omni1394/fake_omni.hpp"
#include "tests/support/umockdev/handler.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::device::omni1394 {

/// A FireWire Omni in a testbed: the kernel's firewire-cdev in front of a double. live() advances
/// its time. All functions may be called from any thread.
class FirewireOmni final : private umockdev::Handler {
public:
    /// At /dev/fw<number>.
    FirewireOmni(umockdev::Testbed& testbed, int number, FakeOmni omni);
    ~FirewireOmni() override;

    /// Plays milliseconds of eight cycles each: sends queued packets, and takes the device's
    /// packets.
    void live(int milliseconds);
    void reset_bus();
    void unplug();
    /// Plugs it in again, at the next number, for programs that reopen it.
    void plug_in();
    /// No register answers while this is on.
    void refuse(bool on);

    template <typename Action>
    auto with_omni(Action action)
    {
        const std::lock_guard lock{mutex_};
        return action(omni_);
    }
    [[nodiscard]] std::string node() const;

private:
    using Bytes = std::vector<std::byte>;
    struct Packet {
        Bytes bytes;
        bool interrupts = false;
    };
    /// A program that has opened it, and its requests.
    struct Client {
        bool has_gone = false;
        /// False after umockdev's own process closed it, which umockdev does not report.
        bool is_in_use = false;
        std::deque<Bytes> events;
        std::optional<std::uint32_t> context; // its type
        std::uint32_t channel = 0;
        std::uint32_t header_size = 0;
        bool runs = false;
        std::deque<Packet> to_send;
        std::size_t sent = 0; // since the last interrupt
        std::size_t room = 0; // for packets to receive
    };

    [[nodiscard]] bool on_ioctl(const umockdev::Request& request) override;
    [[nodiscard]] bool on_read(const umockdev::Request& request) override;
    void on_closed(const void* opener) override;
    [[nodiscard]] int answer(const umockdev::Request& request, Client& client);
    void get_info(const umockdev::Request& request) const;
    void send_request(const umockdev::Request& request, Client& client);
    void allocate(const umockdev::Request& request, Client& client);
    [[nodiscard]] int create_context(const umockdev::Request& request, Client& client);
    [[nodiscard]] int queue(const umockdev::Request& request, Client& client);
    void transmit(Client& client, int cycles);
    void receive(Client& client, const Bytes& packet);
    void tell(Client& client, Bytes event);
    void silence();
    void attach();

    umockdev::Testbed& testbed_;
    int number_;
    FakeOmni omni_;
    std::mutex mutex_;
    std::map<const void*, Client> clients_;
    std::uint32_t generation_ = 1;
    std::int32_t channels_given_ = 0;
    unsigned cycle_ = 0;
    bool refuses_ = false;
    int master_ = -1; // master of the terminal that stands for the node: a byte in it is a bell
    int slave_ = -1;
    std::optional<umockdev::Attachment> attachment_; // the last member, because it uses the others
};

} // namespace hapnet::device::omni1394
