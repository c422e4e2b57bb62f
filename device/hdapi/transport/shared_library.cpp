// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/transport/shared_library.hpp"

#include <array>
#include <dlfcn.h>
#include <spdlog/fmt/fmt.h>

namespace hapnet::device::hdapi {

namespace {

constexpr std::array usual_names{"libHD.so", "libHD.so.3.4", "libHD.so.3.4.0", "libHD.so.3.0"};

std::string last_complaint()
{
    const char* text = dlerror();
    return text == nullptr ? "no reason given" : text;
}

Opened<void*> open_library(const std::string& file)
{
    std::string complaint;
    if (!file.empty()) {
        // dlopen() looks through the system's folders for a name without a slash.
        const std::string path = file.find('/') == std::string::npos ? "./" + file : file;
        if (void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL)) return library;
        complaint = last_complaint();
    } else {
        for (const char* name : usual_names) {
            if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
            if (complaint.empty()) complaint = last_complaint();
        }
    }
    return device_error(
        Fault::library_missing,
        fmt::format("cannot load libHD, the vendor's library ({}): install OpenHaptics "
                    "and the device's driver from 3D Systems, or say --hd-library FILE",
                    complaint));
}

/// Finds functions by name; remembers the first that is not there.
class Finder {
public:
    explicit Finder(void* library) : library_{library} {}

    template <typename Function>
    void find(Function*& function, const char* name)
    {
        function = reinterpret_cast<Function*>(dlsym(library_, name));
        if (function == nullptr && missing_.empty()) missing_ = name;
    }
    [[nodiscard]] const std::string& missing() const { return missing_; }

private:
    void* library_;
    std::string missing_;
};

} // namespace

Opened<Functions> load_library(const std::string& file)
{
    const auto library = open_library(file);
    if (!library) return tl::unexpected{library.error()};
    Functions all;
    Finder finder{*library};
    finder.find(all.init_device, "hdInitDevice");
    finder.find(all.disable_device, "hdDisableDevice");
    finder.find(all.make_current_device, "hdMakeCurrentDevice");
    finder.find(all.begin_frame, "hdBeginFrame");
    finder.find(all.end_frame, "hdEndFrame");
    finder.find(all.get_error, "hdGetError");
    finder.find(all.get_error_string, "hdGetErrorString");
    finder.find(all.enable, "hdEnable");
    finder.find(all.disable, "hdDisable");
    finder.find(all.get_booleans, "hdGetBooleanv");
    finder.find(all.get_integers, "hdGetIntegerv");
    finder.find(all.get_doubles, "hdGetDoublev");
    finder.find(all.set_doubles, "hdSetDoublev");
    finder.find(all.get_string, "hdGetString");
    finder.find(all.check_calibration, "hdCheckCalibration");
    finder.find(all.update_calibration, "hdUpdateCalibration");
    finder.find(all.start_scheduler, "hdStartScheduler");
    finder.find(all.stop_scheduler, "hdStopScheduler");
    finder.find(all.set_scheduler_rate, "hdSetSchedulerRate");
    finder.find(all.schedule_asynchronous, "hdScheduleAsynchronous");
    finder.find(all.unschedule, "hdUnschedule");
    if (finder.missing().empty()) return all;
    return device_error(
        Fault::library_missing,
        fmt::format("{} is no libHD that this program knows: it has no {}(); OpenHaptics "
                    "3.0 to 3.4 has it",
                    file.empty() ? "libHD.so" : file, finder.missing()));
}

} // namespace hapnet::device::hdapi
