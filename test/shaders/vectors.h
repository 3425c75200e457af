// Vectors for C++ stand-ins of shading languages.
struct float2 {
    float x, y;
    float2(float a, float b) : x(a), y(b) {}
};

struct float3 {
    float x, y, z;
    float3(float a, float b, float c) : x(a), y(b), z(c) {}
    float operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};

inline float3 operator+(float3 a, float3 b) {
    return float3(a.x + b.x, a.y + b.y, a.z + b.z);
}
inline float3 operator-(float3 a, float3 b) {
    return float3(a.x - b.x, a.y - b.y, a.z - b.z);
}
inline float3 operator*(float3 a, float b) {
    return float3(a.x * b, a.y * b, a.z * b);
}
inline float dot(float3 a, float3 b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
