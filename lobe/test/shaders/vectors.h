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

inline float2 operator+(float2 a, float2 b) {
    return float2(a.x + b.x, a.y + b.y);
}
inline float2 operator*(float2 a, float b) {
    return float2(a.x * b, a.y * b);
}
inline float dot(float2 a, float2 b) {
    return a.x * b.x + a.y * b.y;
}
inline float3 operator+(float3 a, float3 b) {
    return float3(a.x + b.x, a.y + b.y, a.z + b.z);
}
inline float3 operator-(float3 a, float3 b) {
    return float3(a.x - b.x, a.y - b.y, a.z - b.z);
}
inline float3 operator-(float3 a) {
    return float3(-a.x, -a.y, -a.z);
}
inline float3 operator*(float3 a, float b) {
    return float3(a.x * b, a.y * b, a.z * b);
}
inline float dot(float3 a, float3 b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
inline float3 cross(float3 a, float3 b) {
    return float3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
