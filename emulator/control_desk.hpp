// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/emulation.hpp"
#include "proto/base/time.hpp"
#include "proto/control/core/conversation.hpp"
#include "proto/control/server.hpp"
#include "proto/control/turns.hpp"
#include "proto/net/text_file.hpp"
#include "proto/net/wake_event.hpp"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace hapnet::emulator {

/// Does the work of a run that takes time and is not urgent, on a thread of its own beside the
/// relaying one. It answers the clients of the control socket, reads the profile again, and tells a
/// terminal how the run goes. It orders work on the paths from the relaying thread, in Turns.
class ControlDesk {
public:
    struct Setup {
        std::optional<std::string> socket{}; // path of the Unix socket
        std::optional<std::string> files{};  // the folder whose files clients may name
        /// The emulation without its work and its folder, which the desk adds.
        Emulation emulation;
        /// Reads the profile again; null: there is none.
        std::function<void(Emulation&)> reload{};
        /// Work that is done from time to time. Returns when the next time is.
        std::function<std::optional<base::TimePoint>(base::TimePoint now,
                                                     const control::DoWork& work)>
            look{};
    };

    /// Makes the socket and the thread, which waits for begin(). Everything that `setup` refers to
    /// outlives it. Throws std::system_error when the socket cannot be made or the folder not be
    /// opened. The signals that are to reach the calling thread alone are blocked already. Without
    /// anything to do there is no thread.
    explicit ControlDesk(Setup setup);
    /// Ends the thread. Open requests of clients are given up.
    ~ControlDesk();
    ControlDesk(const ControlDesk&) = delete;
    ControlDesk& operator=(const ControlDesk&) = delete;

    // Call these on the relaying thread.

    /// Lets the desk begin. From now on the calling thread does the work of turns(), and does not
    /// touch the parts that the desk uses. It may be called again.
    void begin();
    /// The work that it is to do.
    [[nodiscard]] control::Turns& turns() { return turns_; }
    [[nodiscard]] const control::Turns& turns() const { return turns_; }
    /// Orders the profile to be read again.
    void reload();
    /// No more is answered; returns once the thread has ended.
    void close();

private:
    void run();

    Setup setup_;
    control::Turns turns_;
    std::unique_ptr<net::Folder> folder_;
    control::Subject subject_;
    std::unique_ptr<control::Server> server_;
    net::WakeEvent wake_;
    std::atomic<bool> wants_reload_{false};
    std::atomic<bool> has_begun_{false};
    std::atomic<bool> is_closing_{false};
    std::thread thread_; // last member: the thread uses the others
};

} // namespace hapnet::emulator
