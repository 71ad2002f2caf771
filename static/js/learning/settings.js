/**
 * Reading what a person typed for a setting. The server checks again; this only says sooner what would be right.
 * @import {SettingInfo} from "#js/learning/types.js"
 */

/**
 * @param {SettingInfo} setting
 * @param {string} text
 * @returns {{ value: number | string, problem: string }}
 */
export function readSetting(setting, text) {
  const trimmed = text
    .trim()
    .replace("−", "-")
    .replace(/^(-?\d+),(\d+)$/, "$1.$2");
  if (trimmed === "") return { value: setting.default, problem: "" };
  if (setting.choices?.length) return { value: trimmed, problem: "" };
  const value = Number(trimmed);
  if (!Number.isFinite(value) || isOutside(setting, value)) return { value: setting.default, problem: wanted(setting) };
  if (setting.whole && !Number.isInteger(value))
    return { value: setting.default, problem: `A whole number is needed here.` };
  return { value, problem: "" };
}

/**
 * @param {SettingInfo} setting
 * @param {number} value
 */
function isOutside({ minimum, maximum }, value) {
  return (minimum !== null && value < minimum) || (maximum !== null && value > maximum);
}

/** @param {SettingInfo} setting */
function wanted({ minimum, maximum }) {
  if (minimum !== null && maximum !== null && maximum < Number.MAX_SAFE_INTEGER)
    return `A number from ${minimum} to ${maximum} is needed here.`;
  return minimum === null ? "A number is needed here." : `A number of at least ${minimum} is needed here.`;
}
