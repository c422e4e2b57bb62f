// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/transport/sender_thread.hpp"

#include "proto/net/wake_event.hpp"

#include <atomic>
#include <semaphore>
#include <thread>
#include <tuple>
#include <utility>

namespace hapnet::device::hid {

struct SenderThread::Shared {
    Shared(std::unique_ptr<Wire> its_wire, PidSender its_sender)
        : wire{std::move(its_wire)}, sender{std::move(its_sender)}
    {}

    void run()
    {
        while (true) {
            // This is read first, so that orders from before it was set are still sent below.
            const bool ends = is_closing;
            while (send_next(mailbox, sender, *wire)) {}
            if (ends) break;
            wake_event.wait();
        }
        wire.reset(); // before done: the destructor's caller may open the device again
        done.release();
    }

    std::unique_ptr<Wire> wire;
    PidSender sender;
    Mailbox mailbox;
    net::WakeEvent wake_event;
    std::atomic<bool> is_closing{false};
    std::binary_semaphore done{0};
};

SenderThread::SenderThread(std::unique_ptr<Wire> wire, PidSender sender)
    : shared_{std::make_shared<Shared>(std::move(wire), std::move(sender))}
{
    std::thread{[shared = shared_] { shared->run(); }}.detach();
}

SenderThread::~SenderThread()
{
    shared_->is_closing = true;
    shared_->wake_event.signal();
    std::ignore = shared_->done.try_acquire_for(close_max);
}

Mailbox& SenderThread::mailbox() { return shared_->mailbox; }

void SenderThread::wake() noexcept { shared_->wake_event.signal(); }

} // namespace hapnet::device::hid
