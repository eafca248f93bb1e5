// Version numbers of the program and of its wire protocol.
#pragma once

namespace headrace::proto {

inline constexpr const char* kProgramVersion = "0.1.0";

// Protocol number. Within one number only additions are made: new methods, new optional members, new fields, new
// event types. A client refuses a server of another number.
inline constexpr int kProtocolVersion = 1;

// Layout number inside the binary frame header and the scene document ("headrace_scene": 1).
inline constexpr int kFrameVersion = 1;
inline constexpr int kSceneVersion = 1;

}  // namespace headrace::proto
