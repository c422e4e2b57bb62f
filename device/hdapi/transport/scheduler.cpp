// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/transport/scheduler.hpp"

#include "device/hdapi/transport/shared_library.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <tuple>

namespace hapnet::device::hdapi {

namespace {

constexpr unsigned long rate_hz = 1000;

Properties properties_of_current(const Functions& functions)
{
    Properties it;
    functions.get_doubles(parameter::usable_workspace, it.workspace_mm.data());
    functions.get_doubles(parameter::force_max, &it.force_max_n);
    functions.get_doubles(parameter::force_continuous, &it.force_continuous_n);
    functions.get_doubles(parameter::stiffness_max, &it.stiffness_max_n_per_mm);
    functions.get_doubles(parameter::damping_max, &it.damping_max_ns_per_mm);
    functions.get_doubles(parameter::velocity_limit, &it.velocity_limit_mm_per_s);
    functions.get_integers(parameter::update_rate, &it.update_rate_hz);
    functions.get_integers(parameter::calibration_style, &it.calibration_styles);
    return it;
}

} // namespace

Opened<std::vector<Opening>> Scheduler::open(const std::vector<std::string>& names)
{
    const std::lock_guard lock{mutex_};
    for (const std::string& name : names) {
        if (std::any_of(open_.begin(), open_.end(),
                        [&](const Opening& one) { return one.name == name; })) {
            return device_error(Fault::in_use,
                                describe_error(name, error::already_open, "open in this program"),
                                error::already_open);
        }
    }
    stop();
    std::vector<Opening> fresh;
    std::optional<DeviceError> why_not;
    for (const std::string& name : names) {
        auto opening = open_one(name);
        if (!opening) {
            why_not = opening.error();
            break;
        }
        fresh.push_back(*opening);
        open_.push_back(*opening);
    }
    if (const auto started = start(); !started && !why_not) why_not = started.error();
    if (!why_not) return fresh;
    stop();
    for (const Opening& opening : fresh) give_back(opening);
    std::ignore = start();
    return tl::unexpected{*why_not};
}

Opened<Opening> Scheduler::open_one(const std::string& name)
{
    std::ignore = first_error(functions_); // discards errors of earlier calls
    const Handle handle = functions_.init_device(name.empty() ? nullptr : name.c_str());
    const ErrorInfo error = first_error(functions_);
    if (handle == no_device || error.code != error::none) {
        const Fault fault =
            fault_of(error.code) == Fault::in_use ? Fault::in_use : Fault::not_found;
        const std::string said = text_of(functions_.get_error_string(error.code));
        return device_error(fault, describe_error(name, error.code, said), error.code);
    }
    functions_.make_current_device(handle);
    Opening opening{.client = nullptr,
                    .name = name,
                    .model = text_of(functions_.get_string(parameter::model)),
                    .serial = text_of(functions_.get_string(parameter::serial)),
                    .properties = properties_of_current(functions_)};
    functions_.disable(capability::force_output);  // until a governor asks for force
    functions_.enable(capability::force_clamping); // the library's own limit, in addition to ours
    std::ignore = first_error(functions_); // discards errors about features that this model lacks
    opening.client = std::make_shared<SchedulerClient>(
        DeviceCycle{functions_, handle, preferred_style(opening.properties.calibration_styles)});
    return opening;
}

void Scheduler::close(const Opening& opening)
{
    const std::lock_guard lock{mutex_};
    stop();
    give_back(opening);
    std::ignore = start(); // for the other devices; a failure makes them silent, which is detected
}

void Scheduler::give_back(const Opening& opening)
{
    const Handle handle = opening.client->handle();
    functions_.make_current_device(handle);
    functions_.disable(capability::force_output);
    functions_.disable_device(handle);
    std::ignore = first_error(functions_);
    std::erase_if(open_, [&](const Opening& one) { return one.client == opening.client; });
}

Opened<bool> Scheduler::start()
{
    if (open_.empty()) return true;
    for (const Opening& opening : open_) opening.client->on_start();
    callback_ = functions_.schedule_asynchronous(&Scheduler::serve_all, this, priority_max);
    functions_.set_scheduler_rate(rate_hz);
    std::ignore = first_error(functions_); // a device with other rates keeps its own
    functions_.start_scheduler();
    is_running_ = true;
    const ErrorInfo error = first_error(functions_);
    if (error.code == error::none) return true;
    return device_error(
        Fault::internal,
        fmt::format("libHD cannot start its scheduler (error 0x{:x}: {}): end other "
                    "programs that use the device, and plug it in again",
                    error.code, text_of(functions_.get_error_string(error.code))),
        error.code);
}

void Scheduler::stop()
{
    if (!is_running_) return;
    for (const Opening& opening : open_) opening.client->begin_silence();
    for (const Opening& opening : open_) opening.client->await_silence();
    functions_.stop_scheduler();
    functions_.unschedule(callback_);
    is_running_ = false;
    std::ignore = first_error(functions_);
}

unsigned int Scheduler::serve_all(void* self)
{
    const auto* scheduler = static_cast<Scheduler*>(self);
    for (const Opening& opening : scheduler->open_) opening.client->serve();
    scheduler->hand_out_errors();
    return callback_continue;
}

void Scheduler::hand_out_errors() const
{
    for (int i = 0; i < errors_max; ++i) {
        const ErrorInfo latest = functions_.get_error();
        if (latest.code == error::none) return;
        const auto is_named = [&](const Opening& one) {
            return one.client->handle() == latest.handle;
        };
        const bool is_of_all = std::none_of(open_.begin(), open_.end(), is_named);
        // The first error that occurred is removed last, and stays, as the others follow from it.
        for (const Opening& one : open_) {
            if (is_of_all || is_named(one)) one.client->note(latest.code);
        }
    }
}

Opened<Scheduler*> scheduler_of(const std::string& file)
{
    // The library exists once per process, with its own state and thread, and is never unloaded. So
    // its scheduler exists once, too, and lives until the process ends.
    static std::mutex mutex;
    static std::map<std::string, std::unique_ptr<Scheduler>> schedulers;
    const std::lock_guard lock{mutex};
    auto& scheduler = schedulers[file];
    if (!scheduler) {
        const auto functions = load_library(file);
        if (!functions) return tl::unexpected{functions.error()};
        scheduler = std::make_unique<Scheduler>(*functions);
    }
    return scheduler.get();
}

} // namespace hapnet::device::hdapi
