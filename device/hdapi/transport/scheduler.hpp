// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/fault.hpp"
#include "device/hdapi/mapping.hpp"
#include "device/hdapi/transport/scheduler_client.hpp"

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace hapnet::device::hdapi {

/// A device as the library opened it.
struct Opening {
    std::shared_ptr<SchedulerClient> client;
    std::string name; // as in the vendor's configuration; "": the default device
    std::string model;
    std::string serial;
    Properties properties;
};

/// The library's one scheduler, which serves all its devices in one callback. May be used by
/// several threads.
class Scheduler {
public:
    explicit Scheduler(const Functions& functions) : functions_{functions} {}

    /// Opens devices by their names, all or none. The scheduler stops for that moment: devices that
    /// are open already have no cycles and zero force then.
    [[nodiscard]] Opened<std::vector<Opening>> open(const std::vector<std::string>& names);
    /// Leaves the device at zero force and closes it.
    void close(const Opening& opening);

private:
    [[nodiscard]] Opened<Opening> open_one(const std::string& name);
    void give_back(const Opening& opening);
    [[nodiscard]] Opened<bool> start();
    /// Stops the scheduler after all devices have zero force, because it is not known whether the
    /// library's own stop sets zero force.
    void stop();
    static unsigned int serve_all(void* self);
    /// Passes each error of the cycle to the device that it names, or to all devices if it names
    /// none of them.
    void hand_out_errors() const;

    Functions functions_;
    std::mutex mutex_;
    std::vector<Opening> open_; // changed only while the scheduler is stopped
    bool is_running_ = false;
    unsigned long callback_ = 0;
};

/// Returns the process's one scheduler of the library in `file`; "": the library by its usual
/// names. The first call loads the library.
[[nodiscard]] Opened<Scheduler*> scheduler_of(const std::string& file);

} // namespace hapnet::device::hdapi
