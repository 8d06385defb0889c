#pragma once

// Large headers that most tests include. A test includes what it uses all the same.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <QtTest>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>
