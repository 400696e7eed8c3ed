#pragma once

#include <opencv2/core.hpp>
#include <opencv2/core/version.hpp>

// OpenCV 4.7 moved ArUco from the contributed modules into objdetect, where a class does the work.
#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 7)
#define RELOCK_ARUCO_IN_OBJDETECT
#include <opencv2/objdetect/aruco_detector.hpp>
#else
#include <opencv2/aruco.hpp>
#endif

#include <vector>

namespace relock::aruco_library {

using Corners = std::vector<std::vector<cv::Point2f>>;

// `rejected`: quadrilaterals that are no marker of the dictionary.
#ifdef RELOCK_ARUCO_IN_OBJDETECT
inline cv::aruco::Dictionary dictionary(int name) { return cv::aruco::getPredefinedDictionary(name); }

inline void detect(const cv::Mat& gray, const cv::aruco::Dictionary& dictionary,
                   const cv::aruco::DetectorParameters& parameters, Corners& corners, std::vector<int>& ids,
                   Corners& rejected) {
  cv::aruco::ArucoDetector(dictionary, parameters).detectMarkers(gray, corners, ids, rejected);
}
#else
inline cv::aruco::Dictionary dictionary(int name) { return *cv::aruco::getPredefinedDictionary(name); }

inline void detect(const cv::Mat& gray, const cv::aruco::Dictionary& dictionary,
                   const cv::aruco::DetectorParameters& parameters, Corners& corners, std::vector<int>& ids,
                   Corners& rejected) {
  cv::aruco::detectMarkers(gray, cv::makePtr<cv::aruco::Dictionary>(dictionary), corners, ids,
                           cv::makePtr<cv::aruco::DetectorParameters>(parameters), rejected);
}
#endif

}  // namespace relock::aruco_library
