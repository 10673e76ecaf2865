#pragma once

#include <map>
#include <string>

#include "shlight/report/report.h"

namespace shlight {

// The whole page: the text of page/thesis.html with the parts' HTML where it has {{id}}. Not installed.
std::string make_page(const Report& report, const ReportParams& params, const std::map<std::string, std::string>& html);

}  // namespace shlight
