/// The files of `built_in/`, embedded at build time (see embed.cmake).
#pragma once

#include <string_view>

namespace paperproof::compare::built_in_texts {

extern const std::string_view base_json;  ///< What every scene begins with.

extern const std::string_view paper_json;
extern const std::string_view angle_json;
extern const std::string_view ground_json;
extern const std::string_view article_json;
extern const std::string_view claims_json;
extern const std::string_view limits_json;
extern const std::string_view one_way_json;
extern const std::string_view moving_json;
extern const std::string_view bodies_json;
extern const std::string_view crowd_json;
extern const std::string_view extreme_json;
extern const std::string_view play_json;
extern const std::string_view tight_json;
extern const std::string_view motions_json;

}  // namespace paperproof::compare::built_in_texts
